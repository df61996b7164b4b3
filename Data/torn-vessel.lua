-- 7 mm of the vessel are lost. A tube from one end into the other joins them again.
local vessel = tissue "vessel"
local ends = components(vessel)
print("pieces: " .. #ends)

-- The vessel runs in an arc; these are points on its middle line, LPS mm.
local bridge = tube{points={{7.7, -1.2, -6}, {8.0, -0.6, -3}, {8.0, 0.1, 0.5}, {7.8, 0.8, 4}, {7.6, 1.4, 7}},
                    radius=2.5, blend=1}
save("vessel", vessel + bridge)
