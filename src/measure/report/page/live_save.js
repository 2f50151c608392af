"use strict";
// Taking things away: files, the command line, the camera.

async function copyText(text, shown) {
  shown.textContent = text;
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    getSelection().selectAllChildren(shown); // to be copied by hand
    return false;
  }
}

function saveBar(page) {
  const said = el("p#said.note", { role: "status" });
  const text = el("pre#copied", { hidden: true });
  const show = async (what, content) => {
    text.hidden = false;
    const done = await copyText(content, text);
    said.textContent = done ? `${what} was copied.` : `${what} is selected: press Ctrl+C to copy it.`;
  };
  page.takeCameraText = ({ text: content }) => show("The camera", content);
  page.takeFile = (head, buffer, at) => {
    saveFile(head.name, new Blob([new Uint8Array(buffer, at)]));
    said.textContent = `${head.name} was saved.`;
  };
  page.say = (message) => {
    said.textContent = message;
  };
  const exr = (slot) => () => page.socket.send({ do: "exr", slot });
  const png = () => {
    page.viewer.draw();
    page.viewer.canvas.toBlob((blob) => saveFile(`${page.stem}.png`, blob), "image/png");
    said.textContent = `${page.stem}.png was saved, as displayed.`;
  };
  const command = () => {
    const slot = page.state && page.state.slots[page.look.view === "b" ? 1 : 0];
    if (!slot || !slot.command) return page.say("There is no image yet.");
    const moved = page.state.moved
      ? "# the camera was moved: copy it into the scene file first\n" : "";
    show("The command", moved + slot.command);
  };
  const button = (id, label, onclick) =>
    el("button.button", { id, onclick }, label);
  return el(
    "div.save", el("div.choices", button("save-png", "Save PNG as displayed", png),
      button("save-exr-a", "Save EXR of A", exr(0)),
      button("save-exr-b", "Save EXR of B", exr(1)),
      button("copy-command", "Copy render command", command),
      button("copy-camera", "Copy camera (pbrt)",
        () => page.socket.send({ do: "camera-text" }))),
    said, text,
  );
}
