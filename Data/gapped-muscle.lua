-- One slice was not drawn. No ball of 5 mm fits into the gap: a closing fills it, and keeps the rest.
local muscle = tissue "muscle"
save("muscle", muscle:closing(5):smooth{time=1, preserve="both"})
