layers()
priority{"humerus", "biceps"}
local b = tissue(2)
local c = components(b)
save("biceps", c[1]:opening(0.5):closing(0.5):keep_largest(1))
save("speckle", tissue(3):drop_small(0.5):fill_cavities():fill_holes(1))
print(bounds(b).min[1], centroid(b)[2], voxel_size()[1])
