"""bridge.py SOCKET: publishes the state of a running system to ROS 2 with CRTK's names, and takes one kind of command.

Needs ROS 2 with rclpy, and PYTHONPATH with Liana's host/api/python. Not run by Liana's tests: they have no ROS.
"""
import math
import sys
import threading

import rclpy
from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from sensor_msgs.msg import JointState

from liana.client import Client, LianaError, RequestRefused


class Bridge(Node):
    """One thread talks to lianad; commands of ROS wait in `wanted` until it sends them."""

    def __init__(self, client):
        super().__init__("liana")
        self.client = client
        base = client.welcome["robot"].get("base", {})
        self.slide_m_per_deg = base.get("slide_m_per_deg")  # theta_1 of a base that feeds is in metres
        self.joints = self.create_publisher(JointState, "joint_states", 10)
        self.measured = self.create_publisher(JointState, "measured_js", 10)
        self.setpoint = self.create_publisher(JointState, "setpoint_js", 10)
        self.pose = self.create_publisher(PoseStamped, "measured_cp", 10)
        self.create_subscription(JointState, "move_jp", self.take_move, 10)
        self.wanted = None

    def take_move(self, message):
        self.wanted = [math.degrees(value) for value in message.position]
        if self.slide_m_per_deg is not None:
            self.wanted[0] = message.position[0] / self.slide_m_per_deg

    def stamp(self, state):
        """Arm time, as in the recordings; set use_sim_time where that matters."""
        whole = int(state["time_s"])
        return Time(sec=whole, nanosec=int(round((state["time_s"] - whole) * 1e9)) % 10**9)

    def joint_state(self, state, key):
        message = JointState()
        message.header.stamp = self.stamp(state)
        message.name = [f"theta_{i}" for i in range(1, len(state[key]) + 1)]
        message.position = [math.radians(value) for value in state[key]]
        if self.slide_m_per_deg is not None:
            message.position[0] = state[key][0] * self.slide_m_per_deg
        return message

    def publish(self, state):
        self.joints.publish(self.joint_state(state, "measured_js_deg"))
        self.measured.publish(self.joint_state(state, "measured_js_deg"))
        self.setpoint.publish(self.joint_state(state, "setpoint_js_deg"))
        message = PoseStamped()
        message.header.stamp = self.stamp(state)
        message.header.frame_id = "base"
        x, y, z, qw, qx, qy, qz = state["measured_cp"]
        message.pose.position.x, message.pose.position.y, message.pose.position.z = x, y, z
        turn = message.pose.orientation
        turn.w, turn.x, turn.y, turn.z = qw, qx, qy, qz
        self.pose.publish(message)

    def talk(self):
        """Until lianad ends. A refused command is said, and the next one may pass."""
        while rclpy.ok():
            state = self.client.step()
            if state["measured_js_deg"]:
                self.publish(state)
            goal_deg, self.wanted = self.wanted, None
            if goal_deg is None:
                continue
            try:
                self.client.call("acquire")
                self.client.call("move_jp", goal_deg=goal_deg)
            except RequestRefused as refused:
                self.get_logger().warning(str(refused))


def main():
    rclpy.init()
    with Client(sys.argv[1], name="ros2_bridge") as client:
        bridge = Bridge(client)
        thread = threading.Thread(target=rclpy.spin, args=(bridge,), daemon=True)
        thread.start()
        try:
            bridge.talk()
        except LianaError as error:
            bridge.get_logger().info(f"lianad: {error}")
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
