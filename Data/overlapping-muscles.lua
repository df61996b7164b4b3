-- Two people drew two muscles that share some voxels. The sheet between them runs half way: each gives up what lies
-- deeper in the other.
local medialis, rectus = tissue "vastus medialis", tissue "rectus femoris"
local shared = medialis * rectus
print(string.format("shared before: %.0f mm^3", volume(shared)))

-- A plane through the middle of what is shared, across the line between the two muscles.
local a, b, m = centroid(medialis), centroid(rectus), centroid(shared)
local across = {b[1] - a[1], b[2] - a[2], b[3] - a[3]}
medialis = medialis - shared * halfspace{point=m, normal={-across[1], -across[2], -across[3]}}
rectus   = rectus   - shared * halfspace{point=m, normal=across}

save("vastus medialis", medialis:keep_largest(1))
save("rectus femoris", rectus:keep_largest(1))
