"""What a scenario runs on: bus, drives and arm. run_scenario.py does the same on each; this is where stands differ."""
import abc


class Stand(abc.ABC):
    """Times in seconds of arm time: how long to wait for what, before a scenario has failed."""

    reach_s = 30.0  # a state
    enabling_s = 75.0  # the pretension ramp alone may take 60
    fault_s = 60.0  # the fault that is expected
    rested_s = 1.0  # how long an end state is watched
    # Faults begin by themselves in slots that the scenario names, also while the arm boots or is enabled. Where not,
    # strike() brings them about once the arm is as `during` says.
    faults_are_scheduled = False

    @abc.abstractmethod
    def start(self, scenario):
        """The system that the scenario runs in, not yet entered."""

    @abc.abstractmethod
    def client(self, system):
        """The scenario's operator; everything that has to see the whole run is started with it."""

    @abc.abstractmethod
    def start_move(self, client):
        """The move of `during: move`."""

    def strike(self, run, system, client):
        """Does to the system what the scenario says; the client to go on with."""
        return client

    def mend(self, run, system):
        """What is put right before the operator clears."""

    @abc.abstractmethod
    def judge(self, run, system, client):
        """Over what the system, which has ended, left behind: adds to the run's notes and violations, or fails."""
