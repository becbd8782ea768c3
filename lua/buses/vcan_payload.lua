-- As embedded_payload, on two virtual CAN interfaces; with real adapters, change the interface names.
local buses = require "buses.embedded_payload"

buses.name, buses.backend = "vcan_payload", "socketcan"
buses.buses[1].name, buses.buses[2].name = "vcan0", "vcan1"
return buses
