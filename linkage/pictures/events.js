/* ---- what happened on the way: marks on the slider of time, below it the latest in words, as delivered; a press goes to the next ---- */

for (const each of strokes) if (each.events) {
  const { slider, events, start, end } = each, marks = make("datalist"), told = make("button"), share = (time) => (1000 * (time - start)) / (end - start);
  const now = () => start + (Number(slider.value) / 1000) * (end - start) + 1e-9 * (end - start);
  marks.id = "events"; told.type = "button"; told.className = "event";
  marks.append(...events.map(([time]) => Object.assign(make("option"), { value: String(share(time)) })));
  slider.setAttribute("list", marks.id);
  slider.parentElement.append(told, marks);
  on(told, "click", (event) => {
    event.preventDefault();
    slider.value = String(share((events.find(([time]) => time > now()) || events[0])[0]));
    slider.dispatchEvent(new Event("input"));
  });
  const tell = () => {
    const text = (events.filter(([time]) => time <= now()).at(-1) || events[0])[1];
    told.textContent = isChanged() ? `${say("as delivered")}: ${text}` : text;
    told.classList.toggle("stale", isChanged());
  };
  new MutationObserver(tell).observe(slider, { attributes: true, attributeFilter: ["aria-valuetext"] });
  tell();
}
