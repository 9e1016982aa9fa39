-- Weigh one of the three peppers: put it on the tray of the scales; the needle must have moved.
return task {
  variations = { colour = { "green", "red", "yellow" } },
  objects = {
    scales = { "kitchen_scales", at = on_table { between(0.14, 0.30), between(-0.20, 0.20) }, yaw = between(math.pi - 0.8, math.pi + 0.8) },
    green_pepper = { "green_pepper" }, red_pepper = { "red_pepper" }, yellow_pepper = { "yellow_pepper" },
  },
  init = { is.on("green_pepper", "table"), is.on("red_pepper", "table"), is.on("yellow_pepper", "table"),
    is.reachable("green_pepper"), is.reachable("red_pepper"), is.reachable("yellow_pepper") },
  goal = { is.on("{colour}_pepper", "scales.tray"), stays("others") },
  also = function(w) return w:joint("scales.needle") > 0.8 end, -- rad
  instructions = {
    "weigh the {colour} pepper",
    "put the {colour} pepper on the kitchen scales",
    "how heavy is the {colour} pepper? set it on the tray of the scales",
    "the scales shall show the weight of the {colour} pepper, and of no other",
  },
}
