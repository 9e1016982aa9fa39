-- A yellow bell pepper.
return require "worlds.lib.pepper" "yellow"
