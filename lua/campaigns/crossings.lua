-- A thousand crossings of the slit, each with another hand, another arm and another camera: the seed decides them.
-- liana campaign crossings; docs/how-to/run-a-campaign.md shows every field.
return {
  format = 1, kind = "campaign", name = "crossings",
  mission = "slit_crossing",
  seeds = { first = 1, count = 1000 },
}
