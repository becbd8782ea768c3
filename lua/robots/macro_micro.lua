-- The pair in series (requirement B1): the small arm on the tip of the large one, whose joints are locked. What moves is the small arm; the
-- large one is its base, and gives way where it is pushed.
local micro, macro = require "robots.micro", require "robots.macro"

micro.name = "macro_micro"
micro.base = {
  robot = macro,
  pose = "install", -- where the large arm is locked
  damping_s = 0.02, -- assumed: of the locked joints, 0.02 s of their stiffness
}
micro.start_pose = "install"
return micro
