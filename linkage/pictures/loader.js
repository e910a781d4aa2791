"use strict";
/* What the page does and knows comes compressed, nine bytes in eleven letters; the security policy names the program by its hash, as it names this. */
const unpacked = async (id) => {
  const text = document.getElementById(id).textContent, bytes = new Uint8Array(9 * Math.ceil(text.length / 11));
  for (let i = 0; i < text.length; i += 11) {
    let sum = 0n;
    for (const letter of text.slice(i, i + 11).padEnd(11, "}")) sum = 94n * sum + BigInt(letter === "~" ? 28 : letter.charCodeAt() - 32);
    for (let k = 9; k--; sum >>= 8n) bytes[(9 * i) / 11 + k] = Number(sum & 255n);
  }
  return new Response(new Blob([bytes.slice(0, Math.floor((9 * text.length) / 11))]).stream().pipeThrough(new DecompressionStream("deflate"))).text();
};
const put = (kind, text) => document.body.append(Object.assign(document.createElement(kind), { textContent: text }));
Promise.all(["body", "style", "program"].map(unpacked)).then(
  ([body, style, program]) => { document.body.insertAdjacentHTML("afterbegin", body); put("style", style); put("script", program); },
  () => document.body.append("This page needs a browser of 2023 or later: Chrome or Edge 80, Safari 16.4, Firefox 113."),
);
