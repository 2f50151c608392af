#!/usr/bin/env python3
"""A page of `lanelight live` without a browser: live_client.py LANELIGHT SCENE [FLAGS]

Opens the socket (RFC 6455), has two strategies compared, moves the camera, waits for
pictures, and leaves; then Ctrl-C. The exit code is that of the program.
"""
import base64
import json
import os
import signal
import socket
import struct
import subprocess
import sys


class Page:
    def __init__(self, address):
        host, path = address.removeprefix("http://").split("/", 1)
        name, port = host.split(":")
        self.socket = socket.create_connection((name, int(port)), timeout=120)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(
            f"GET /{path}socket HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\n"
            f"Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: {key}\r\n"
            "Sec-WebSocket-Version: 13\r\n\r\n".encode())
        self.stream = self.socket.makefile("rb")
        assert b" 101 " in self.stream.readline()
        while self.stream.readline() != b"\r\n":
            pass

    def send(self, message):
        text = json.dumps(message).encode()
        assert len(text) < 126 or len(text) < 65536
        size = (bytes([0x80 | len(text)]) if len(text) < 126
                else bytes([0x80 | 126]) + struct.pack(">H", len(text)))
        self.socket.sendall(b"\x81" + size + bytes(4) + text)  # masked with zeros

    def receive(self):
        """The head of the next message."""
        whole, final = b"", 0
        while not final:
            first, size = self.stream.read(2)
            final = first & 0x80
            if size == 126:
                size, = struct.unpack(">H", self.stream.read(2))
            elif size == 127:
                size, = struct.unpack(">Q", self.stream.read(8))
            part = self.stream.read(size)
            if first & 15 in (0, 1, 2):
                whole += part
                is_text = first & 15 == 1 or (first & 15 == 0 and is_text)
        if is_text:
            return json.loads(whole)
        size, = struct.unpack("<I", whole[:4])
        return json.loads(whole[4:4 + size])

    def wait(self, wanted):
        """Says what it has seen, as the page does, until wanted(head)."""
        while True:
            head = self.receive()
            if head["kind"] == "state":
                self.send({"do": "seen", "what": 2})
            if head["kind"] == "picture":
                self.send({"do": "seen", "what": head["slot"]})
            if wanted(head):
                return head


def main():
    program = subprocess.Popen([sys.argv[1], "live", *sys.argv[2:]], text=True,
                               stdout=subprocess.PIPE)
    page = Page(program.stdout.readline().strip())
    eye = page.wait(lambda head: head["kind"] == "hello")["eye"]
    for slot, name in enumerate(("paper-importance", "default")):
        page.send({"do": "strategy", "slot": slot, "name": name})
    page.wait(lambda head: head["kind"] == "picture" and head["slot"] == 1)
    eye["position"][0] += 0.1
    page.send({"do": "camera", "eye": eye})
    page.wait(lambda head: head["kind"] == "picture" and head["view"] == 1)
    page.wait(lambda head: head["kind"] == "state")
    page.socket.close()
    program.send_signal(signal.SIGINT)
    sys.exit(program.wait(timeout=120))


if __name__ == "__main__":
    main()
