-- A fridge that gives ice: in the niche of its front, which looks along -x, a lever hangs that a cup pushes back. Its
-- frame is 0.75 m above the floor.
local places = require "worlds.lib.places"
local steel, dark, ice = { 0.78, 0.80, 0.83 }, { 0.16, 0.17, 0.19 }, { 0.80, 0.92, 0.98 }
local width, high, front, back, deep = 0.40, 0.40, -0.12, 0.12, 0.09 -- m; deep: of the niche
local side, foot, roof = 0.130, 0.05, 0.33                           -- m: half the width of the niche, its floor and its roof
local most = math.rad(15)

local function slab(y, z, wide, tall, colour)
  return box { deep, wide, tall, at = { front + deep / 2, y, z }, colour = colour }
end

local function light(colour, when_lit)
  return box { 0.002, 0.03, 0.012, at = { front - 0.021, 0, high - 0.03 }, colour = colour, collides = false, shows = when_lit }
end

local shapes = {
  box { back - front, width, 0.75, at = { 0, 0, -0.375 }, colour = { 0.45, 0.47, 0.50 } }, -- what it stands on
  box { back - front - deep, width, high, at = { (front + deep + back) / 2, 0, high / 2 }, colour = dark },
  slab(0, foot / 2, width, foot), slab(0, (roof + high) / 2, width, high - roof),
  box { 0.02, 0.10, 0.02, at = { front - 0.01, 0, high - 0.03 }, colour = dark },          -- its lamp, dark and alight
  light({ 0.30, 0.32, 0.30 }, is_not.pressed("lever")), light({ 0.20, 0.95, 0.35 }, is.pressed("lever")),
}
for _, y in ipairs { 1, -1 } do
  shapes[#shapes + 1] = slab(y * (side + width / 2) / 2, (foot + roof) / 2, width / 2 - side, roof - foot)
end
for i, y in ipairs { -0.045, 0, 0.040 } do -- ice that missed the cup
  shapes[#shapes + 1] = box { 0.020, 0.020, 0.018, at = { front + 0.05 - 0.012 * i, y, foot + 0.009 }, yaw = 0.5 * i, colour = ice,
    collides = false, shows = is.pressed("lever") }
end

return object {
  type = "furniture", traits = {}, fixed = true, colour = steel, shapes = shapes,
  place = places.beside_the_table { gap = 0.15, turn = deg(45), wide = 0.40 },
  parts = {
    lever = {
      type = "lever", traits = { "pressable" }, mass = 0.05, colour = { 0.92, 0.93, 0.95 }, friction = 0.3,
      hinge = { axis = { 0, -1, 0 }, at = { front + 0.018, 0, roof - 0.012 }, range = { 0, most },
        spring = 0.20, damping = 0.02, friction = 0.02 },
      shapes = { cylinder { 0.006, 0.06, rpy = { math.pi / 2, 0, 0 } }, box { 0.008, 0.042, 0.150, at = { 0, 0, -0.075 } } },
      regions = {
        spot = { at = { -0.004, 0, -0.105 }, size = { 0.002, 0.04, 0.02 } },  -- where the rim of a cup comes
        zone = { at = { -0.045, 0, -0.140 }, size = { 0.07, 0.07, 0.09 } },   -- where its middle is then
      },
      numbers = { on_at = math.rad(8) },
    },
  },
}
