---@meta
-- What `arm` offers to `run`, `finish` and conditions, annotated for editors. Never loaded; a test compares it with the registered commands.
-- Every command sends one request to lianad (docs/api.md) and returns its id at once; a refusal fails the step.

---@class Arm
---@field state table the last state message, docs/api.md
---@field robot table the robot, docs/formats.md
---@field scene table the scene, docs/formats.md
---@field period_s number control period
---@field begin_tick integer tick at which the current step began
---@field was_engaged boolean the operator has engaged the device in this step
---@field must_hold table<integer, number> theta number -> degrees the current step holds
local arm = {}

-- ---- looking ----------------------------------------------------------------------------------------------------

---Angles (deg) of a named pose of the robot.
---@param name string
---@return number[]
function arm.named_pose(name) end

---The scene's slit or rod; raises when it has none.
---@param name string
---@return table
function arm.part_of_scene(name) end

---Measured tip position in the base frame [m].
---@return number[]
function arm.tip() end

---How far the tip is along the slit, measured from the base [m].
---@return number
function arm.slit_u() end

---Signed distance of the tip from the slit's middle plane [m].
---@return number
function arm.slit_offset() end

---Whether exactly the variables of this step are held.
---@return boolean
function arm.holds_what_it_should() end

---Time of the arm since a tick [s].
---@param since integer
---@return number
function arm.elapsed_s(since) end

-- ---- commanding -------------------------------------------------------------------------------------------------

---Owns motion. The mission runner does this by itself before the first step.
---@return integer id
function arm.acquire() end

---Gives motion back.
---@return integer id
function arm.release() end

---CRTK operating state.
---@param fields { command: string } enable, disable, clear or home
---@return integer id
function arm.state_command(fields) end

---Joint goal, all joints together on a minimum-jerk path.
---@param fields { goal_deg: number[], rate_deg_s?: number }
---@return integer id
function arm.move_jp(fields) end

---Tip goal [x,y,z,qw,qx,qy,qz] along a straight line; `hold` as `held` of hold_theta, in force from the start.
---@param fields { goal: number[], hold?: table[] }
---@return integer id
function arm.move_cp(fields) end

---Stream of tip targets, at most one per command interval.
---@param fields { goal: number[] }
---@return integer id
function arm.servo_cp(fields) end

---Holds variables { { theta = 9, target_deg = 0 }, ... }; an empty list releases all. Steps do this through their field `hold`.
---@param fields { held: table[] }
---@return integer id
function arm.hold_theta(fields) end

---Null-space targets of nodes { { node = 3, position_m = {x,y,z}, weight = 1, threshold_m = 0.01 }, ... } and points
---that the arm's middle keeps its distance from { { centre_m = {x,y,z}, distance_m = 0.3, weight = 1 }, ... }; an empty list clears them.
---With `search` the best of all shapes is looked for and gone to first (arm at rest).
---@param fields { nodes: table[], keep_clear?: table[], search?: boolean }
---@return integer id
function arm.shape(fields) end

---Who steers and how hand motion maps. Steps do this through their fields `device` and `steer`.
---@param fields { device: string, scale?: number, rotation_scale?: number, node?: integer, speed_m_s?: number }
---@return integer id
function arm.use_device(fields) end

---Back along the verified path, as far as a tick.
---@param fields { until_tick?: integer }
---@return integer id
function arm.retract(fields) end

---Stops along the path and stays enabled.
---@return integer id
function arm.hold() end

---A command to the tool at the tip; logged.
---@param fields { command: string }
---@return integer id
function arm.tool(fields) end

---Stop, brakes, disable.
---@param fields { reason: string }
---@return integer id
function arm.stop(fields) end

---Tells the operator which step runs. The mission runner does this by itself.
---@param fields { step?: table }
---@return integer id
function arm.announce(fields) end

return arm
