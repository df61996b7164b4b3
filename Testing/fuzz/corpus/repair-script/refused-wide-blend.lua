save("b", union(tissue "biceps", capsule{from={5, 5, 2}, to={9, 5, 4}, radius=1.5}, {blend=82}))
