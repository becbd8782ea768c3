-- What kind of arm a robot has, and what follows from it for missions. A robot of kind "robot" has cables and segments, one of kind "serial"
-- has joints (docs/formats.md).
local kind = {}

function kind.is_serial(robot) return robot.kind == "serial" end

-- How many angles a pose of the robot has.
function kind.angle_count(robot)
  if kind.is_serial(robot) then return #robot.joints end
  return 2 * #robot.segments
end

-- Range of angle i [deg].
function kind.range_deg(robot, i)
  if kind.is_serial(robot) then return robot.joints[i].low_deg, robot.joints[i].high_deg end
  local limit_deg = robot.segments[(i + 1) // 2].theta_limit_deg
  return -limit_deg, limit_deg
end

-- Fastest rate that a joint motion may ask for [deg/s]; each joint keeps its own limit besides.
function kind.rate_deg_s(robot)
  if not kind.is_serial(robot) then return robot.limits.theta_rate_deg_s end
  local fastest = 0
  for _, joint in ipairs(robot.joints) do fastest = math.max(fastest, joint.rate_deg_s) end
  return fastest
end

-- Angles that a step can hold: those of a cable arm. A serial arm's joints all serve the tip.
function kind.held_count(robot) return kind.is_serial(robot) and 0 or kind.angle_count(robot) end

-- Nodes between the base and the tip that a mission can steer.
function kind.node_count(robot) return kind.is_serial(robot) and 0 or #robot.segments - 1 end

return kind
