save("a", tissue "bicep")
