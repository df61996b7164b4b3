coordinates "RAS"
coordinates "LPS"
local s = sphere{center={6,6,6}, radius="3vox"} + ellipsoid{center={6,6,6}, radii={2,3,4}}
s = s - cylinder{from={0,6,6}, to={12,6,6}, radius=1} * torus{center={6,6,6}, axis={0,0,1}, radius=3, tube=1}
s = union(s, cone{from={1,1,1}, to={1,1,5}, radius=2, end_radius=1}, tube{points={{1,1,1},{5,5,5},{9,1,1}}, radius={1,2,1}}, {blend=0.5})
s = s + hull{points={{0,0,0},{4,0,0},{0,4,0},{0,0,4}}} - halfspace{point={0,0,5}, normal={0,0,-1}}
s = s:translate{1,0,0}:scale{factor=1.1, center={6,6,6}} + mesh{file="tet.stl"} * tissue "biceps"
if volume(s) > 0 then save("s", s) end
