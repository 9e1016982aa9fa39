-- Open the top drawer of everything that has one.
return task {
  world = "tabletop",
  objects = { chest = { "chest", at = { 0.52, 0, 0.75 } } },
  goal = {
    forall("?f: furniture", is.open("?f.top_drawer")),
    forall("?f: furniture", is_not.open("?f.middle_drawer")),
    is_not(exists("?part: drawer", all_of(is.part_of("?part", "chest"), is.behind("?part", "chest.bottom_drawer")))),
    is.hand_empty(),
  },
  instructions = { "open each top drawer" },
}
