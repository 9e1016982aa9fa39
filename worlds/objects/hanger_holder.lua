-- A low holder for one hanger.
return require "worlds.lib.rails" (0.22, 0.09)
