-- LIBERO's words, beside those that are built in.
return {
  dialect = "libero",
  extend = true, -- what stands here goes before the built-in categories, sites, parts and rules
  categories = { -- theirs, ours: an object's file or a type; the first that fits is taken, in either direction
    { "red_cube", "cube" },
  },
  predicates = {
    { theirs = "on", ours = "on", meaning = "weaker",
      why = "theirs also asks that the centres are within 3 cm, or that the object is in the region's box" },
  },
}
