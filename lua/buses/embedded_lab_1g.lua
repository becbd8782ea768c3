-- The 9 drives of lab_1g and the load cells of its cables, three on a node, on one classical 1 Mbit/s bus at 200 Hz.
local buses = require "buses.embedded_three_segment_lab"

buses.name = "embedded_lab_1g"
buses.buses[1].load_cells = {
  { node = 32, cables = { 1, 2, 3 } },
  { node = 33, cables = { 4, 5, 6 } },
  { node = 34, cables = { 7, 8, 9 } },
}
buses.load_cell = {
  newtons_per_step = 0.02, -- 500 N are 25000 steps
  range_N = 500,
  agree_N = 20, -- torque tells tension to a few per cent
  when_lost = "torque",
}
return buses
