-- How a skill takes the joint of a part to a position: with as many grips as the arm needs for that.
local grips = {}

local most = 16     -- grips in all
local least = 0.02  -- rad or m that a grip must move the part on

-- Grips the part and takes it towards the position `to` as far as the arm can follow; lets go and goes back. `o`: speed,
-- most_force and pivot as of robot:move_part, away: how far the hand goes back, opening: of the hand before and after it
-- (else the grasp's).
function grips.take(robot, part, grasp, to, o)
  robot:open_hand(o.opening or grasp.opening)
  robot:move_through({ approach = grasp.approach, grasp = grasp.pose },
    { then_part = part, to = grasp.reach or to, pivot = o.pivot, opening = grasp.width, retreat = o.away })
  robot:close_hand(part, { force = grasp.force })
  robot:move_part(part, to,
    { speed = o.speed, most_force = o.most_force, pivot = o.pivot, retreat = o.away, as_far_as_it_goes = true })
  robot:open_hand(o.opening or grasp.opening)
  robot:retreat(o.away, { as_far_as_it_goes = true })
end

-- Calls again(grasp) with another grasp, each time from where the part is by then, until enough() says that it is far
-- enough; gives up where a grip gets nowhere.
function grips.go_on(robot, part, to, o, enough, again)
  local w = robot:view()
  for _ = 2, most do
    if enough() then return end
    local before = w:joint(part)
    local grasp = robot:find_grasp(part, to, { pivot = o.pivot, retreat = o.away })
    if not grasp then return end -- what came of it, the effect's test says
    again(grasp)
    if math.abs(w:joint(part) - before) < least then
      robot:fail("stuck", "the " .. part .. " did not move on with another grip")
    end
  end
end

return grips
