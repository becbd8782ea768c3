-- What macro_micro_stiff is on where no bus table is named: embedded_payload.
local buses = require "buses.embedded_payload"
buses.name = "embedded_macro_micro_stiff"
return buses
