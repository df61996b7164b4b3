-- A drill went through the shaft. The bore has two mouths, so it is a hole that can be filled by its width.
local femur = tissue "femur"
save("femur", femur:fill_holes(6))
