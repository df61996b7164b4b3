for name, t in pairs(tissues()) do print(name, t) end
for _, t in ipairs(tissues "*") do
  local n = 0
  for i = 1, 3 do n = n + i // 2 end
  print(t.name, string.format("%5.2f", volume(t)), #t.name .. "x")
end
local function twice(f, x) return f(f(x)) end
print(twice(function(x) return x * 2 end, 2), math.floor(2.5), table.concat({1, 2}, ","), setting("a", 3))
