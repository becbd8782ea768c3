-- What comes after a step: the step written next, or what its `next` says. Loops end because every way back says how often
-- it may be taken.
local did_you_mean = require "liana.did_you_mean"
local refuse = require "liana.refuse"

local ways = {}

ways.kFinish = "finish" -- the name of the end in `next`
local kMostTimes = 1000

local kFields = {
  step = { allowed = "the name of a step, or \"finish\"", ok = function(v) return type(v) == "string" end },
  when = {
    allowed = "a condition, such as at_pose \"park\"",
    ok = function(v) return type(v) == "table" and type(v.met) == "function" and type(v.text) == "string" end,
  },
  on = { allowed = "\"success\" or \"failure\"", ok = function(v) return v == "success" or v == "failure" end },
  at_most = {
    allowed = "a whole number from 1 to " .. kMostTimes,
    ok = function(v) return math.type(v) == "integer" and v >= 1 and v <= kMostTimes end,
  },
}

local function check_way(where, way)
  if type(way) ~= "table" then refuse(where, "way", way, "{ step = \"name\", when = condition }", "correct the way") end
  for field, value in pairs(way) do
    local rule = kFields[field]
    if not rule then refuse(where, tostring(field), value, "step, when, on, at_most", "remove it or correct its spelling") end
    if not rule.ok(value) then refuse(where, field, value, rule.allowed, "correct the way") end
  end
  if way.step == nil then refuse(where, "step", "missing", kFields.step.allowed, "say where the way leads") end
end

-- The list of ways that `next` is short for: "name", one way, or a list of ways.
local function listed(next)
  if next == nil then return {} end
  if type(next) == "string" then return { { step = next } } end
  if next.step ~= nil then return { next } end
  return next
end

-- Steps by name; false for a name that several have.
local function index_by_name(steps)
  local index = {}
  for i, step in ipairs(steps) do
    if index[step.name] == nil then index[step.name] = i else index[step.name] = false end
  end
  return index
end

-- What a way can lead to: a name that two steps have leads nowhere.
local function names(given, steps, index)
  local known = { ways.kFinish }
  for _, step in ipairs(steps) do
    if index[step.name] then table.insert(known, #known, step.name) end
  end
  return "\"" .. table.concat(known, "\", \"") .. "\"" .. did_you_mean(given, known)
end

local function numbers_of(name, steps)
  local out = {}
  for i, step in ipairs(steps) do
    if step.name == name then out[#out + 1] = tostring(i) end
  end
  return table.concat(out, " and ")
end

-- The number of the step that a way leads to, one more than there are for the end.
local function target_of(where, way, steps, index)
  local target = index[way.step]
  if way.step == ways.kFinish then
    if target ~= nil then refuse(where, "step", way.step, "either the end or a step of that name", "rename the step") end
    return #steps + 1
  end
  if target then return target end
  if target == nil then refuse(where, "step", way.step, names(way.step, steps, index), "name one step of this mission") end
  refuse(where, "step", way.step, "a name that one step has; steps " .. numbers_of(way.step, steps) .. " have it", "rename all but one of them")
end

-- A way that is always taken: what is written behind it never is.
local function is_final(way) return way.when == nil and way.at_most == nil end

local function resolved(where, own, next, steps, index)
  local out, final = {}, {}
  for i, way in ipairs(listed(next)) do
    local here = where .. (type(next) == "table" and next.step == nil and ("[%d]"):format(i) or "")
    check_way(here, way)
    local on = way.on or "success"
    local target = target_of(here, way, steps, index)
    if target <= own and way.at_most == nil then
      refuse(here, "at_most", "missing", kFields.at_most.allowed, "say how often the mission may come back to \"" .. way.step .. "\"")
    end
    if final[on] then refuse(here, "way", "never taken", "ways behind others that have when or at_most", "put it first, or remove it") end
    final[on] = is_final(way)
    out[i] = { target = target, step = way.step, when = way.when, on = on, at_most = way.at_most, is_final = is_final(way) }
  end
  return out
end

local function check_list(where, next)
  if next == nil or type(next) == "string" then return end
  local allowed = "\"name\", { step = \"name\", when = condition, at_most = 3 }, or a list of such ways"
  if type(next) ~= "table" then refuse(where, "next", next, allowed, "correct the field") end
  if next.step ~= nil then return end
  local count = 0
  for _ in pairs(next) do count = count + 1 end
  if count == 0 or count ~= #next then refuse(where, "next", "a table without step", allowed, "correct the field") end
end

-- Sets `ways` of every step: { { target = 3, step = name, when, on, at_most, is_final }, ... }. `where_of(step number)` is
-- its name in messages.
function ways.resolve(steps, where_of)
  local index = index_by_name(steps)
  for i, step in ipairs(steps) do
    check_list(where_of(i), step.next)
    step.ways = resolved(where_of(i) .. ": next", i, step.next, steps, index)
  end
end

-- Numbers of the steps that may follow step `i`; one more than there are is the end.
function ways.followers(steps, i)
  local out, goes_on = {}, true
  for _, way in ipairs(steps[i].ways) do
    out[#out + 1] = way.target
    if way.is_final and way.on == "success" then goes_on = false end
  end
  if goes_on then out[#out + 1] = i + 1 end
  return out
end

-- Whether two holds are of the same angles at the same targets.
function ways.same_hold(a, b)
  for theta, target_deg in pairs(a) do if b[theta] ~= target_deg then return false end end
  for theta in pairs(b) do if a[theta] == nil then return false end end
  return true
end

local function hold_text(hold)
  local out = {}
  for theta, target_deg in pairs(hold) do out[#out + 1] = ("[%s] = %s"):format(tostring(theta), tostring(target_deg)) end
  return #out > 0 and "{ " .. table.concat(out, ", ") .. " }" or "{}"
end

-- What the steps without `hold` hold: what every step that leads to them does. Refuses a step to which steps lead that hold
-- differently, and one that nothing leads to.
function ways.settle_holds(steps, where_of)
  local from, open, given = { [1] = "the start" }, { 1 }, {}
  for i, step in ipairs(steps) do given[i] = step.hold ~= nil end
  steps[1].hold = steps[1].hold or {}
  while #open > 0 do
    local i = table.remove(open)
    for _, target in ipairs(ways.followers(steps, i)) do
      local step = steps[target]
      if step and from[target] == nil then
        from[target], open[#open + 1] = "\"" .. steps[i].name .. "\"", target
        step.hold = step.hold or steps[i].hold
      elseif step and not given[target] and not ways.same_hold(step.hold, steps[i].hold) then
        refuse(where_of(target), "hold", "missing",
          ("after %s the arm holds %s, after \"%s\" %s"):format(from[target], hold_text(step.hold), steps[i].name, hold_text(steps[i].hold)),
          "say what this step holds")
      end
    end
  end
  for i in ipairs(steps) do
    if from[i] == nil then refuse(where_of(i), "step", "never begins", "steps that another one leads to", "correct next, or remove the step") end
  end
end

return ways
