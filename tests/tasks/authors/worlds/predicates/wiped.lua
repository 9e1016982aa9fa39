-- The tip of a tool has been within 1 cm of the middle of the stain.
return predicate {
  params = { "stain: stain" },
  label = "the {stain} has been wiped",
  momentary = true, remember = true,
  holds = function(w, stain)
    for _, tool in ipairs(w:objects("tool")) do
      if w:exists(tool .. ".tip") and w:distance(tool .. ".tip", stain) < 0.01 then return true end
    end
    return false
  end,
}
