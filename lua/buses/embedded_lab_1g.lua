-- The 15 drives of lab_1g as in buses/embedded.lua, and the load cells of its cables, three on a node.
local buses = require "buses.embedded"

buses.name = "embedded_lab_1g"
buses.buses[1].load_cells = {
  { node = 32, cables = { 1, 2, 3 } },
  { node = 33, cables = { 4, 5, 6 } },
  { node = 34, cables = { 7, 8, 9 } },
}
buses.buses[2].load_cells = {
  { node = 35, cables = { 10, 11, 12 } },
  { node = 36, cables = { 13, 14, 15 } },
}
buses.load_cell = {
  newtons_per_step = 0.02, -- 500 N are 25000 steps
  range_N = 500,
  agree_N = 20, -- torque tells tension to a few per cent
  when_lost = "torque",
}
return buses
