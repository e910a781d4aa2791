"use strict";
/* What the page does and knows comes compressed; the security policy names the program by its hash, as it names this. */
const unpacked = async (id) => {
  const bytes = Uint8Array.from(atob(document.getElementById(id).textContent), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).text();
};
const put = (kind, text) => document.body.append(Object.assign(document.createElement(kind), { textContent: text }));
Promise.all(["style", "program"].map(unpacked)).then(
  ([style, program]) => { put("style", style); put("script", program); },
  () => document.body.append("This page needs a browser of 2023 or later: Chrome or Edge 80, Safari 16.4, Firefox 113."),
);
