-- As pick, but no pot in which something stands.
return skill { extends = "pick", precondition = { is_not(exists("?x: movable", is.in_slot("?x", "obj.hollow"))) } }
