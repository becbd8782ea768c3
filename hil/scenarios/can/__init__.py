"""Scenarios on CAN interfaces of the kernel, and where they run (README.md)."""
