-- Take the pepper that is weighed off the scales and put it on the table; the needle goes back.
return task {
  variations = { colour = { "green", "red", "yellow" } },
  objects = {
    scales = { "kitchen_scales", at = on_table { between(0.14, 0.30), between(-0.20, 0.20) }, yaw = between(math.pi - 0.8, math.pi + 0.8) },
    green_pepper = { "green_pepper" }, red_pepper = { "red_pepper" }, yellow_pepper = { "yellow_pepper" },
  },
  init = function(v)
    return each({ "green", "red", "yellow" }, function(colour)
      return is.on(colour .. "_pepper", colour == v.colour and "scales.tray" or "table")
    end)
  end,
  goal = { is.on("green_pepper", "table"), is.on("red_pepper", "table"), is.on("yellow_pepper", "table") },
  also = function(w) return w:joint("scales.needle") < 0.2 end, -- rad
  instructions = {
    "take the {colour} pepper off the scales",
    "the {colour} pepper has been weighed: put it back on the table",
    "free the tray of the scales; its {colour} pepper goes on the table",
    "move the {colour} pepper from the kitchen scales to the table",
  },
}
