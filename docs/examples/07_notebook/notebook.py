# %% [markdown]
# # A simulated arm, its recording, and a picture
# Each `# %%` begins a cell. The arm is simulated, and its time is virtual.

# %% Move the arm, and keep the recording
import sys

from liana import BenchEnvironment, Recording, System

with System(expect="client,archive", scene="none") as system:
    system.start_archive()
    client = system.client()
    client.enable()
    client.start_moving(change_deg=4.0)
    client.until(lambda state: not state["is_busy"], limit_s=60)
    system.shut_down(client)
    recording = Recording(system.directory / "ticks.mcap")
    arrays, truth = recording.arrays(), system.truth().arrays()

# %% All ticks are arrays now: a row for each tick, a column for each drive
tension_N = arrays["tension_N"]
print(f"{tension_N.shape[0]} ticks of {1000 * recording.period_s:g} ms, {tension_N.shape[1]} cables")
print(f"largest tension by torque {tension_N.max():.0f} N, in the simulator {truth['tension_motor_max_N'].max():.0f} N")

# %% An environment for learning: this policy goes straight to the goal
with BenchEnvironment("micro") as environment:
    observation, info = environment.reset(seed=7)
    limit_m_s = environment.action_space.high[0]
    is_over = False
    while not is_over:
        tip_m, goal_m = observation[-6:-3], observation[-3:]
        action = [max(-limit_m_s, min(limit_m_s, goal - tip)) for tip, goal in zip(tip_m, goal_m)]
        observation, reward, terminated, truncated, info = environment.step(action)
        is_over = terminated or truncated
print(f"goal reached: {terminated}, {1000 * info['distance_m']:.1f} mm from it after {info['time_s']:.1f} s")

# %% The picture
try:
    import matplotlib
except ImportError:
    sys.exit("notebook: the picture needs matplotlib, which is not there: install python3-matplotlib")
matplotlib.use("Agg")  # a file; leave this out in a notebook
from matplotlib import pyplot

figure, axes = pyplot.subplots(figsize=(8, 4))
axes.plot(arrays["time_s"], tension_N)
axes.axhline(recording.robot()["tension"]["alarm_N"], color="black", linestyle="--", label="alarm")
axes.set_xlabel("arm time [s]")
axes.set_ylabel("tension [N]")
axes.legend()
figure.savefig("tensions.png")
print("tensions.png is written")
