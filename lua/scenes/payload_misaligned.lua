-- The scene payload_at_adapter as no servo would leave it: the pins begin as far beside the adapter's axis as its funnels take, and turned.
local geometry = require "liana.geometry"
local scene = require "scenes.payload_at_adapter"

local kFarther_m = 0.032 -- from the face: a pin so far aside, on the low side of the turn, is still before the wall of its funnel
local kAside_m, kTurned_deg = 0.02, 1 -- at most; aside in x and in y: up to 28 mm of the 30 that a funnel is wide

local payload, adapter = scene.payload, scene.adapter
local axis = geometry.rotated({ 0, 0, 1 }, adapter.quaternion_wxyz)
adapter.position_m = geometry.add(adapter.position_m, axis, kFarther_m)
payload.start_lateral_m, payload.start_tilt_deg = kAside_m, kTurned_deg

scene.name = "payload_misaligned"
return scene
