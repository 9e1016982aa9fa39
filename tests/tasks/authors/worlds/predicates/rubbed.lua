-- The hand has got to the far corner of the area in this episode, and pressed on the table there.
return predicate {
  params = { "area: marked" },
  label = "the {area} has been rubbed",
  momentary = true,
  remember = true,
  holds = function(w, area)
    local x, y = w:position(area)
    local tx, ty = w:position(w:hand())
    return tx < x - 0.02 and ty > y + 0.03 and w:force(w:hand(), "table") > 3
  end,
}
