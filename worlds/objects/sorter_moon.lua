-- The moon of the shape sorter, a crescent that opens to +x.
return require "worlds.lib.sorter_solids".make("moon", "purple", { { -0.004, 0, 0, 0.047 } }) -- from horn to horn
