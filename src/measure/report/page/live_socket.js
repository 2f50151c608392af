"use strict";
// The socket to the program: messages out as JSON, in as JSON or as a head of JSON with
// bytes behind it (src/measure/live/picture.h).

// Splits a binary message: {head, bytes: DataView from where they begin}.
function splitBinary(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const text = new TextDecoder().decode(new Uint8Array(buffer, 4, length));
  return { head: JSON.parse(text), at: 4 + length };
}

// handlers: one function for each "kind" of message: f(message, buffer, at), and closed().
function openSocket(handlers) {
  const address = new URL("socket", location.href);
  address.protocol = "ws:";
  const socket = new WebSocket(address);
  socket.binaryType = "arraybuffer";
  let said = false; // goodbye
  socket.addEventListener("message", ({ data }) => {
    const binary = typeof data !== "string";
    const { head, at } = binary ? splitBinary(data) : { head: JSON.parse(data), at: 0 };
    if (head.kind === "goodbye") said = true;
    const handle = handlers[head.kind];
    if (handle) handle(head, data, at);
  });
  socket.addEventListener("close", () => handlers.closed(said));
  return {
    send(message) {
      if (socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify(message));
    },
    // Nothing is handled any more.
    end() {
      for (const kind of Object.keys(handlers)) handlers[kind] = () => {};
      socket.close();
    },
  };
}
