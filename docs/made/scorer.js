// How results are ranked: by how much a page is about the words (ABOUT), guides before what is generated, the changelog last.
const KINDS = [[/^howto\/|^(quickstart|sketch|excavator|redesign|levelled)$/, 3], [/^_generated\/(api|machines)\//, -4], [/^(changelog|design|upgrading)$/, -9]];
var Scorer = {
  score: ([page, , , , score]) => {
    const typed = (new URLSearchParams(location.search).get("q") || "").toLowerCase().match(/[\p{L}\p{N}]+/gu) || [];
    const own = ABOUT[page] || {};
    const sum = typed.reduce((sum, word) => sum + (own[word.length > 3 ? word.replace(/s$/, "") : word] || 0), 0);
    const kind = KINDS.find(([pages]) => pages.test(page));
    return score + (typed.length ? sum / typed.length : 0) + (kind ? kind[1] : 0);
  },
  objNameMatch: 11, objPartialMatch: 6, objPrio: {0: 15, 1: 5, 2: -5}, objPrioDefault: 0,
  title: 15, partialTitle: 7, term: 5, partialTerm: 2,
};
