"""What the buttons of a plot save."""

SAVED = """
  const done = arguments[arguments.length - 1], [name, kind] = arguments;
  const click = HTMLAnchorElement.prototype.click;
  HTMLAnchorElement.prototype.click = async function () {
    HTMLAnchorElement.prototype.click = click;
    const bytes = new Uint8Array(await (await new Response(window.lastBlob)).arrayBuffer());
    done({name: this.download, text: new TextDecoder().decode(bytes), size: bytes.length,
          first: bytes[1]});
  };
  const make = URL.createObjectURL;
  URL.createObjectURL = (blob) => { window.lastBlob = blob; return make(blob); };
  document.querySelector(`[data-plot="${name}"] + .export [data-export="${kind}"]`).click();
"""


def saved(page, name, kind):
    return page.js_async(SAVED, name, kind)
