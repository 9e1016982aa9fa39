-- A fact in two parts: the cube is in the box, and the box is shut.
return task {
  world = "tabletop",
  objects = {
    crate = { "lidded_box", at = { 0.22, 0.15, 0.75 }, joints = { lid = deg(100) } },
    item = { "small_cube", at = { 0.15, -0.20, 0.766 } },
  },
  goal = { is.put_away("item", "crate"), is.hand_empty() },
  instructions = { "put the cube away" },
}
