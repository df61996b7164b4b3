-- Specks around and pinholes inside: in every tissue, whatever its name, drop and fill what is below a size.
for _, organ in ipairs(tissues()) do
  local before = volume(organ)
  local mended = organ:drop_small(100):fill_cavities(100)
  print(string.format("%s: %.0f -> %.0f mm^3", organ.name, before, volume(mended)))
  save(organ.name, mended)
end
