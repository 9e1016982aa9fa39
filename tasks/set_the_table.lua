-- Set the table for one: bowl, fork, knife, spoon and glass each on its place of the mat.

-- Where the napkin lies: to one side of the mat.
local function beside(side)
  return { at = on_table { between(0.05, 0.30), between(0.38 * side - 0.03, 0.38 * side + 0.03) }, yaw = between(-0.4, 0.4) }
end

return task {
  objects = {
    mat = { "place_mat", at = on_table { between(0.11, 0.21), between(-0.06, 0.06) }, yaw = between(-0.15, 0.15) },
    napkin = { "napkin", place = one_of { beside(1), beside(-1) } },
    bowl = { "bowl" }, fork = { "fork" }, knife = { "table_knife" }, spoon = { "spoon" },
    glass = { "tumbler", colour = { 0.70, 0.85, 0.90 } },
  },
  init = {
    is.inside("fork", "napkin.left"), is.inside("knife", "napkin.middle"), is.inside("spoon", "napkin.right"),
    is.on("bowl", "table"), is.on("glass", "table"), is.spaced("bowl", "mat.left"), is.spaced("bowl", "mat.right"),
    is.outside("glass", "mat.outline"), is.outside("bowl", "napkin.outline"), is.outside("glass", "napkin.outline"),
    is_not.crowds("bowl", "fork"), is_not.crowds("glass", "fork"), is_not.crowds("bowl", "spoon"), is_not.crowds("glass", "spoon"),
  },
  goal = {
    is.inside("bowl", "mat.middle"), is.inside("fork", "mat.left"), is.inside("knife", "mat.right"),
    is.inside("spoon", "mat.outer_right"), is.inside("glass", "mat.corner"),
  },
  also = function(w) -- the cutlery lies as its place does
    for item, place in pairs { fork = "left", knife = "right", spoon = "outer_right" } do
      local _, _, yaw = (w:pose("mat." .. place):inverse() * w:pose(item)):rpy()
      if math.abs(yaw) > 0.2 then return false end
    end
    return true
  end,
  horizon = 240, -- s
  instructions = {
    "set the table",
    "lay the table for one: bowl, fork, knife, spoon and glass",
    "put the bowl, the cutlery and the glass on their places of the mat",
    "somebody is coming to dinner: arrange everything on the mat",
  },
}
