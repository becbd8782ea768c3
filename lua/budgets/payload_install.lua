-- Where a payload ends that the macro-micro arm carries to its adapter (Liu et al.; requirements B7 to B9). "source" marks what
-- the paper states; everything else is assumed, with the reason beside it.
return {
  format = 1, kind = "budget", name = "payload_install",

  -- Flown by calculation alone. The arms' connections count nothing here: source.
  open_loop = {
    errors = {
      { name = "macro", position_m = 0.050, angle_deg = 1 }, -- source: absolute error of the large arm
      { name = "micro", position_m = 0.010, angle_deg = 1 }, -- source: of the small arm
    },
    terms = { -- source: the lengths; that an angle counts over all that comes after it, and how terms add up: the reading that gives its 142 mm
      { name = "macro, at the end of the micro", positions = { "macro" }, angles = { "macro" }, lever_m = 5 },
      { name = "micro", positions = { "micro" } },
      { name = "both angles over the payload", angles = { "macro", "micro" }, lever_m = 1 },
    },
  },

  -- Led by the camera at the adapter: what the arms know no longer counts, what the camera sees and the arm repeats does.
  closed_loop = {
    errors = {
      { name = "camera", position_m = 0.002, angle_deg = 0.2 }, -- source
      { name = "micro repeats", position_m = 0.005, angle_deg = 0.1 }, -- assumed: half and a tenth of its absolute errors
    },
    terms = {
      { name = "camera and micro", positions = { "camera", "micro repeats" } },
      { name = "both angles over the payload", angles = { "camera", "micro repeats" }, lever_m = 1 },
    },
  },
}
