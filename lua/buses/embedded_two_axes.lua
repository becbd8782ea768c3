-- 15 drives on 8 nodes with two motors each: drive 1 is node 1, drive 2 its axis 2, drive 3 node 2; node 8 has one.
local function with_two_axes(nodes)
  local axes = {}
  for _, node in ipairs(nodes) do
    axes[#axes + 1] = node
    if node ~= 8 then axes[#axes + 1] = { node = node, axis = 2 } end
  end
  return axes
end

return {
  format = 1, kind = "buses", name = "embedded_two_axes", backend = "embedded",
  rate_hz = 250,
  command_interval_s = 0.02,
  buses = {
    { name = "can0", bitrate = 1000000, nodes = with_two_axes { 1, 2, 3, 4 } },
    { name = "can1", bitrate = 1000000, nodes = with_two_axes { 5, 6, 7, 8 } },
  },
  heartbeat_ms = 100,
  max_load = 0.75,
}
