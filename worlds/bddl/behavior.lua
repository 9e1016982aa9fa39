-- BEHAVIOR's words (synsets) and ours.
return {
  dialect = "behavior",
  extend = false, -- this is the whole mapping; a file of your own adds to it
  domain = "behavior-1k",
  support = "on",
  within = "inside",
  hand = "panda.hand", -- what their agent is here
  zone = "air_zone",
  room = "kitchen", -- where scene objects stand, unless `rooms` says otherwise
  categories = { -- theirs, ours: an object's file or a type; the first that fits is taken, in either direction
    { "table.n.02", "work_table" },
    { "breakfast_table.n.01", "work_table" },
    { "cabinet.n.01", "chest" },
    { "chest.n.02", "chest" },
    { "push_button.n.01", "push_button" },
    { "floor.n.01", "floor" },
    { "block.n.01", "cube" },
    { "mug.n.04", "mug" },
    { "plate.n.04", "plate" },
    { "saucepan.n.01", "saucepan" },
    { "chopping_board.n.01", "chopping_board" },
    { "umbrella.n.01", "umbrella" },
    { "tray.n.01", "tray" },
    { "ashcan.n.01", "bin" },
    { "agent.n.01", "hand" },
  },
  parts = { chest = { "bottom_drawer", "middle_drawer", "top_drawer" } },
  stands = { -- what opens towards the robot, or is pressed by it, stands where the arm reaches it
    chest = { x = { 0.52, 0.55 }, y = { 0.12, 0.16 }, z = 0.75 },
    push_button = { x = { 0.10, 0.30 }, y = { -0.28, -0.10 }, z = 0.75 },
  },
  predicates = {
    { theirs = "ontop", ours = "on", meaning = "stronger",
      why = "theirs asks for contact and that one is above the other, ours that the contact force carries it" },
    { theirs = "onfloor", ours = "on", meaning = "stronger", why = "as for ontop; in the problems of 2021 only" },
    { theirs = "inside", ours = "inside", meaning = "incomparable",
      why = "theirs casts rays from the object that must meet the container, ours asks that its centre is in the inner box" },
    { theirs = "open", ours = "open", meaning = "stronger",
      why = "theirs asks that any joint has moved a small share of its range, ours that this one is open far enough to use" },
    { theirs = "open", ours = "closed", negated = true, meaning = "stronger",
      why = "ours asks for shut to within its play, theirs for not open" },
    { theirs = "toggled_on", ours = "pressed", meaning = "weaker",
      why = "theirs toggles with each press and asks for now, ours that it has been pressed once" },
    { theirs = "grasped", ours = "holding", meaning = "equal",
      why = "theirs by an attached constraint, ours by friction between the pads" },
  },
}
