-- A corner of a cube, from a mesh file that says green.
return object { type = "cube", traits = { "movable" }, shape = mesh { "wedge.obj" }, mass = 0.05 }
