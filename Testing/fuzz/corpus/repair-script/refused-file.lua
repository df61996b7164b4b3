io.open("a")
