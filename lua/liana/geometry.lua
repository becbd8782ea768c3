-- Forward kinematics and small vector algebra in plain Lua, for scenes and missions (metres, radians, base frame).
-- Rotations are three rows; a pose is { position = {x, y, z}, rotation = {row, row, row} }.
local geometry = {}

-- a . b
function geometry.dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end

-- a x b
function geometry.cross(a, b)
  return { a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1] }
end

-- a + factor b
function geometry.add(a, b, factor)
  factor = factor or 1
  return { a[1] + factor * b[1], a[2] + factor * b[2], a[3] + factor * b[3] }
end

-- factor a
function geometry.scale(a, factor) return { factor * a[1], factor * a[2], factor * a[3] } end

-- Length of a [m].
function geometry.length(a) return math.sqrt(geometry.dot(a, a)) end

-- a with length 1.
function geometry.unit(a) return geometry.scale(a, 1 / geometry.length(a)) end

-- Distance of two points [m].
function geometry.distance(a, b) return geometry.length(geometry.add(a, b, -1)) end

-- a turned by a rotation vector in degrees.
function geometry.turned(a, turn_deg)
  local angle = math.rad(geometry.length(turn_deg))
  if angle == 0 then return a end
  local axis = geometry.unit(turn_deg)
  local along = geometry.scale(axis, (1 - math.cos(angle)) * geometry.dot(axis, a))
  return geometry.add(geometry.add(along, a, math.cos(angle)), geometry.cross(axis, a), math.sin(angle))
end

-- Column k of a rotation: axis k of the frame, in base coordinates.
function geometry.axis(rotation, k) return { rotation[1][k], rotation[2][k], rotation[3][k] } end

local function times(a, b)
  local out = {}
  for i = 1, 3 do
    out[i] = {}
    for k = 1, 3 do out[i][k] = a[i][1] * b[1][k] + a[i][2] * b[2][k] + a[i][3] * b[3][k] end
  end
  return out
end

local function rotation_z(angle)
  local c, s = math.cos(angle), math.sin(angle)
  return { { c, -s, 0 }, { s, c, 0 }, { 0, 0, 1 } }
end

local function rotation_x(angle)
  local c, s = math.cos(angle), math.sin(angle)
  return { { 1, 0, 0 }, { 0, c, -s }, { 0, s, c } }
end

local function rotation_y(angle)
  local c, s = math.cos(angle), math.sin(angle)
  return { { c, 0, s }, { 0, 1, 0 }, { -s, 0, c } }
end

-- Odd modules turn Rz(pitch) Ry(yaw), even ones Ry(yaw) Rz(pitch) (DH rows of the source, table 1).
local function module_rotation(module, pitch, yaw)
  if module % 2 == 1 then return times(rotation_z(pitch), rotation_y(yaw)) end
  return times(rotation_y(yaw), rotation_z(pitch))
end

-- Poses of the ends of all segments for theta in degrees; the last one is the tip. A base that feeds is none of them, its
-- slide and roll come first in theta.
function geometry.segment_ends(robot, theta_deg)
  local rotation = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }
  local position = { 0, 0, 0 }
  local base = 0
  if robot.base then
    position[1] = robot.base.slide_m_per_deg * theta_deg[1]
    rotation = rotation_x(math.rad(theta_deg[2]))
    base = 2
  end
  local ends = {}
  for m, segment in ipairs(robot.segments) do
    local pitch, yaw = math.rad(theta_deg[base + 2 * m - 1]), math.rad(theta_deg[base + 2 * m])
    for i = 1, segment.modules do
      rotation = times(rotation, module_rotation(i, pitch, yaw))
      position = geometry.add(position, geometry.axis(rotation, 1), segment.module_length_m)
    end
    ends[m] = { position = position, rotation = rotation }
  end
  return ends
end

-- Ends of all links of a serial arm for joint angles in degrees, by its DH table; the last one is the tip.
local function link_ends(robot, joint_deg)
  local rotation = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }
  local position = { 0, 0, 0 }
  local ends = {}
  for i, joint in ipairs(robot.joints) do
    rotation = times(rotation, rotation_z(math.rad(joint_deg[i] + (joint.offset_deg or 0))))
    position = geometry.add(position, geometry.axis(rotation, 3), joint.d_m)
    position = geometry.add(position, geometry.axis(rotation, 1), joint.a_m)
    rotation = times(rotation, rotation_x(math.rad(joint.alpha_deg)))
    ends[i] = { position = position, rotation = rotation }
  end
  return ends
end

-- Pose of the tip for theta in degrees, of either kind of arm.
function geometry.tip(robot, theta_deg)
  local ends = robot.kind == "serial" and link_ends(robot, theta_deg) or geometry.segment_ends(robot, theta_deg)
  return ends[#ends]
end

-- Unit quaternion {w, x, y, z} of a rotation, w >= 0: the largest component first, so that no square root loses digits.
function geometry.quaternion(r)
  local squares = {
    1 + r[1][1] + r[2][2] + r[3][3], 1 + r[1][1] - r[2][2] - r[3][3],
    1 - r[1][1] + r[2][2] - r[3][3], 1 - r[1][1] - r[2][2] + r[3][3],
  }
  local k = 1
  for i = 2, 4 do if squares[i] > squares[k] then k = i end end
  local x, y, z = r[3][2] - r[2][3], r[1][3] - r[3][1], r[2][1] - r[1][2]
  local xy, xz, yz = r[1][2] + r[2][1], r[1][3] + r[3][1], r[2][3] + r[3][2]
  local rows = { { squares[1], x, y, z }, { x, squares[2], xy, xz }, { y, xy, squares[3], yz }, { z, xz, yz, squares[4] } }
  local q = rows[k]
  local length = math.sqrt(q[1] ^ 2 + q[2] ^ 2 + q[3] ^ 2 + q[4] ^ 2)
  if q[1] < 0 then length = -length end
  return { q[1] / length, q[2] / length, q[3] / length, q[4] / length }
end

-- a turned by a unit quaternion {w, x, y, z}.
function geometry.rotated(a, q)
  local axis = { q[2], q[3], q[4] }
  local t = geometry.scale(geometry.cross(axis, a), 2)
  return geometry.add(geometry.add(a, t, q[1]), geometry.cross(axis, t))
end

-- The attitude of quaternion b as seen in the frame of quaternion a: a's inverse times b.
function geometry.quaternion_between(a, b)
  local w, x, y, z = a[1], -a[2], -a[3], -a[4]
  return {
    w * b[1] - x * b[2] - y * b[3] - z * b[4], w * b[2] + x * b[1] + y * b[4] - z * b[3],
    w * b[3] - x * b[4] + y * b[1] + z * b[2], w * b[4] + x * b[3] - y * b[2] + z * b[1],
  }
end

-- Poses as requests have them, { x, y, z, qw, qx, qy, qz }: b, which is told in the frame of a, in the frame that a is told in.
function geometry.compose(a, b)
  local attitude = { a[4], a[5], a[6], a[7] }
  local p = geometry.add({ a[1], a[2], a[3] }, geometry.rotated({ b[1], b[2], b[3] }, attitude))
  local q = geometry.quaternion_between({ a[4], -a[5], -a[6], -a[7] }, { b[4], b[5], b[6], b[7] })
  return { p[1], p[2], p[3], q[1], q[2], q[3], q[4] }
end

-- The frame that pose a is told in, in the frame of a.
function geometry.inverse(a)
  local p = geometry.rotated({ -a[1], -a[2], -a[3] }, { a[4], -a[5], -a[6], -a[7] })
  return { p[1], p[2], p[3], a[4], -a[5], -a[6], -a[7] }
end

return geometry
