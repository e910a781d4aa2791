/* ---- what leaves a page: a text that is copied, a file ---- */

/* Copy a text, and say so for a moment where a word stands. */
async function copied(text, word) {
  try { await navigator.clipboard.writeText(text); } catch {
    const area = make("textarea", { value: text });
    document.body.append(area); area.select(); document.execCommand("copy"); area.remove();
  }
  const before = word.textContent;
  if (word.dataset?.busy || before === say("Copied")) return;
  word.textContent = say("Copied");
  setTimeout(() => { word.textContent = before; }, 1500);
}
/* Give a file to the browser. */
function handed(name, kind, content) {
  const link = make("a", { href: URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type: kind })), download: name });
  document.body.append(link); link.click(); link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
