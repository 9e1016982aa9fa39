-- LIBERO's words and ours.
return {
  dialect = "libero",
  extend = false, -- this is the whole mapping; a file of your own adds to it
  domain = "robosuite",
  problem_name = "libero_tabletop_manipulation", -- their Python class of the arena
  support = "on",
  within = "inside",
  hand = "panda.hand",
  zone = "air_zone",
  categories = { -- theirs, ours: an object's file or a type; the first that fits is taken, in either direction
    { "table", "work_table" },
    { "main_table", "work_table" },
    { "kitchen_table", "work_table" },
    { "living_room_table", "work_table" },
    { "study_table", "work_table" },
    { "coffee_table", "work_table" },
    { "wooden_cabinet", "chest" },
    { "white_cabinet", "chest" },
    { "flat_stove", "push_button" },
    { "floor", "floor" },
    { "wooden_block", "cube" },
    { "porcelain_mug", "mug" },
    { "red_coffee_mug", "mug" },
    { "white_yellow_mug", "mug" },
    { "alphabet_soup", "soup_can" },
    { "chocolate_pudding", "chocolate_jelly" },
    { "wooden_tray", "serving_tray" },
  },
  instances = { table = "main_table" }, -- the one name that their arena knows
  unsaid = { "floor" }, -- stands in the arena whatever the problem says
  unknown = { "wooden_block" }, -- categories that their object library lacks: who loads the problem registers them
  sites = { -- ends of names of sites on their fixtures, and parts of ours; "" is the thing itself
    { "top_region", "top_drawer" },
    { "middle_region", "middle_drawer" },
    { "bottom_region", "bottom_drawer" },
    { "top_side", "" },
    { "cook_region", "" },
    { "contain_region", "" },
  },
  parts = { chest = { "bottom_drawer", "middle_drawer", "top_drawer" } },
  stands = { -- what opens towards the robot, or is pressed by it, stands where the arm reaches it
    chest = { x = { 0.52, 0.55 }, y = { 0.12, 0.16 }, z = 0.75 },
    microwave = { x = { 0.53, 0.57 }, y = { -0.10, 0.10 }, z = 0.75 },
    push_button = { x = { 0.10, 0.30 }, y = { -0.28, -0.10 }, z = 0.75 },
  },
  predicates = {
    { theirs = "on", ours = "on", meaning = "weaker",
      why = "theirs also asks that the centres are within 3 cm horizontally, or that the object is in the region's box" },
    { theirs = "in", ours = "inside", meaning = "equal",
      why = "both ask that the object's centre is in the box; of an object that is no region theirs also asks for contact" },
    { theirs = "open", ours = "open", meaning = "equal",
      why = "of a fixture with several joints theirs asks for any of them" },
    { theirs = "close", ours = "closed", meaning = "equal",
      why = "of a fixture with several joints theirs asks for all of them" },
    { theirs = "turnon", ours = "pressed", toggles = true, meaning = "weaker", -- what is on at the start is off once pressed
      why = "theirs asks that the knob is on now, ours that it has been pressed once" },
    { theirs = "turnoff", ours = "pressed", negated = true, toggles = true, meaning = "stronger",
      why = "ours asks that it was never pressed, theirs that it is off now" },
    { theirs = "up", ours = "lifted", meaning = "incomparable",
      why = "theirs asks for a height of 1 m in the world, ours that the hand holds it and nothing else holds it up" },
  },
}
