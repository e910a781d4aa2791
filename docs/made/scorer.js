"use strict";
// How results are ranked: a page whose title has the words comes first; guides come before what is generated and before the changelog.
const KINDS = [[/^howto\/|^(quickstart|sketch|excavator|redesign|levelled)$/, 3], [/^_generated\/(api|machines)\//, -4], [/^(changelog|design)$/, -5]];
var Scorer = {
  score: ([page, title, , , score]) => {
    const words = (new URLSearchParams(location.search).get("q") || "").toLowerCase().split(/\s+/).filter(Boolean);
    const own = title.toLowerCase().split(" > ")[0];
    const found = words.filter(word => own.includes(word.length > 3 ? word.replace(/s$/, "") : word)).length;
    const kind = KINDS.find(([pages]) => pages.test(page));
    return score + (words.length ? 12 * found / words.length : 0) + (kind ? kind[1] : 0);
  },
  objNameMatch: 11, objPartialMatch: 6, objPrio: {0: 15, 1: 5, 2: -5}, objPrioDefault: 0,
  title: 15, partialTitle: 7, term: 5, partialTerm: 2,
};
