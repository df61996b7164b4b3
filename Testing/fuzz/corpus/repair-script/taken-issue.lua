local b = tissue "biceps"
local h = tissue "humerus"
b = b + capsule{from={6, 5, 2}, to={9, 5, 4}, radius=1.5, blend=1} -- belly
b = (b - h:offset(0.5)):smooth{time=1.0, preserve="volume"}
save("biceps", b)
save("gap", box{min={0,0,0}, max={3,4,3}}:rotate{axis={0,0,1}, degrees=15}, {color={0.9,0.5,0.4}})
remove "speckle"
