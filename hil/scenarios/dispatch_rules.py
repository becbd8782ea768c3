"""There is no path around verification: whatever telecommand reached the core was passed by both ends and released
before. Reads commands.txt (docs/reference/formats.md) beside the recording.
"""
ENDS = {"execution", "simulation"}
SPEAKS = ENDS | {"setpoint", "release", "refusal"}


def lives(lines):
    """What commands.txt says, line by line: (tick, stage, sequence, number), of stages that belong to a command."""
    for line in lines:
        if line.startswith("#"):
            continue
        tick, stage, sequence, number = line.split("\t")[:4]
        if stage in SPEAKS and sequence:
            yield int(tick), stage, int(sequence), int(number or 0)


def released(lines):
    """Sequence of every command that was let out -> tick; and complaints about those that no two ends had passed."""
    passed, let_out, complaints = {}, {}, []
    for tick, stage, sequence, number in lives(lines):
        if stage == "setpoint":
            passed[sequence] = set()
        elif stage in ENDS and number == 0:
            passed.setdefault(sequence, set()).add(stage)
        elif stage == "release":
            let_out[sequence] = tick
            missing = ENDS - passed.get(sequence, set())
            if missing:
                complaints.append(f"tick {tick}: command {sequence} was released without {', '.join(sorted(missing))}")
    return let_out, complaints


def unverified(ticks, lines):
    """Telecommands in the core's inputs that nobody had released; each is named once."""
    let_out, complaints = released(lines)
    seen = set()
    for tick in ticks:
        for sequence in {tick.sequence, tick.active_sequence} - {0} - seen:
            seen.add(sequence)
            if sequence not in let_out:
                complaints.append(f"tick {tick.tick}: command {sequence} is in the core and was never released")
            elif let_out[sequence] > tick.tick:
                complaints.append(f"tick {tick.tick}: command {sequence} is in the core before it was released")
    return complaints
