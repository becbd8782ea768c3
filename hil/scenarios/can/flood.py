"""Datagrams to the machine itself, as fast as they go: one of the loads beside a latency measurement."""
import socket

end = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
end.bind(("127.0.0.1", 0))
while True:
    for _ in range(100):
        end.sendto(bytes(1000), end.getsockname())
    end.recv(2000)
