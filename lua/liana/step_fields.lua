-- What each field of a step means, in the order in which docs/reference/mission-language.md lists them
-- (docs/mission_page.py makes the page of it).
return {
  { "device", "who teleoperates: `\"vr\"`, `\"hand\"`, `\"pointer\"`, a device by its name, or `\"none\"`" },
  { "teleoperate", "how hand motion maps: `scale`, `rotation_scale`, `node` (which the left VR hand moves), `speed_m_s`, `frame` (the hand's axes)" },
  { "fixtures", "which of the scene's fixtures act on the hand: `true` (else: all), `false` or a list of names" },
  { "feedback", "law of the force on the operator's hand: `\"aligned\"` (else), `\"claim\"`, `\"abstract\"` or `\"off\"`" },
  { "task", "what the operator does: for `vr` the recording `NAME.hand` beside the mission or of Liana's, for `hand` `\"slit\"` or `\"rod\"`" },
  { "hold", "held angles and their targets in degrees, `{ [9] = 0 }`; left out: what every step that leads here holds; `{}` releases all" },
  { "enter", "condition to begin; waited for up to `enter_limit_s`" },
  { "enter_limit_s", "how long to wait for `enter` (else 10 s)" },
  { "run", "what to do at the beginning: an action, or a function of `arm`" },
  { "plan", "instead of `run` and `exit`: a plan's file beside the mission, followed from rest to rest" },
  { "exit", "condition to end with success" },
  { "fail_when", "condition to end as failed, by name; checked before `exit` in every command interval, from 0.1 s after `run`" },
  { "time_limit_s", "the step fails after this time of the arm; [slowed time](../how-to/write-a-mission.md#how-a-step-goes) counts in part" },
  { "on_fail", "`\"hold\"`, `\"stop\"` (brakes, disable), `\"retract\"` (back to where the first step with it began) or `\"pause\"` (waits)" },
  { "next", "the next step, see [branches and loops](../how-to/write-a-mission.md#branches-and-loops); left out: the step written next" },
  { "confirm", "what an operator has to confirm before the step begins, such as `\"cover removed\"`" },
}
