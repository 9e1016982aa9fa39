-- Table lamps with a push button on the front of their foot, as far from the stem as a hand needs. The bulb shines, or
-- goes out, once the button has been pressed.
local lamps = {}

local metal, dark, shining = { 0.30, 0.32, 0.36 }, { 0.42, 0.42, 0.44 }, { 1.00, 0.93, 0.55 }

-- `lit`: it shines until the button is pressed.
function lamps.shapes(lit)
  local after, before = lit and dark or shining, lit and shining or dark
  return {
    box { 0.28, 0.10, 0.018, at = { 0, 0, 0.009 }, colour = metal },
    cylinder { 0.008, 0.10, at = { 0.10, 0, 0.068 }, colour = { 0.72, 0.60, 0.32 } }, -- stem
    cylinder { 0.018, 0.030, at = { 0.10, 0, 0.128 }, colour = metal }, -- socket
    sphere { 0.036, at = { 0.10, 0, 0.172 }, colour = after, shows = is.pressed("button") }, -- bulb
    sphere { 0.036, at = { 0.10, 0, 0.172 }, colour = before, collides = false, shows = is_not.pressed("button") },
  }
end

function lamps.table_lamp()
  return object {
    type = "lamp", traits = {}, fixed = true, shapes = lamps.shapes(false),
    parts = {
      button = {
        type = "button", traits = { "pressable" }, mass = 0.04, colour = { 0.92, 0.92, 0.90 },
        slider = { axis = { 0, 0, -1 }, at = { -0.10, 0, 0.018 }, range = { 0, 0.005 }, spring = 4, damping = 1,
          friction = 0.2 },
        shapes = { cylinder { 0.018, 0.014, at = { 0, 0, 0.007 } } },
        numbers = { on_at = 0.0035 },
      },
    },
  }
end

return lamps
