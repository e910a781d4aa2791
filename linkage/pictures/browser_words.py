"""What a live page says, in English, as its script and its text have it. `{gap}` and the like are filled in there."""

from __future__ import annotations

from ..language import language, noted, translated

SAID = (
    noted("{what}: a change point, where two branches cross"),
    noted("{what}: {step} is {gap} short"),
    noted("{what}: {step} cannot be placed"),
    noted("{what} stops here"),
    noted("Drag {name}"),
    noted("longest arrow {force}"),
    noted("as delivered only: this column is not followed in the page"),
    noted("dashed: as delivered"),
    noted("assembly"),
    noted("assembled over the whole stroke, {stroke} from {from} to {to}"),
    noted("{from} to {to}"),
    noted("not assembled at {stroke} = {spans}"),
    noted("dead point"),
    noted("the nearest is at {joint}: least transmission angle {angle} at {where}"),
    noted("of {step} at {where}, where the reach ends"),
    noted("least {extreme} at {where}; not below {limit} ({text})"),
    noted("greatest {extreme} at {where}; not above {limit} ({text})"),
    noted("{gap} too long closed"),
    noted("{gap} missing open"),
    noted("pins {low} to {high} apart; the cylinder is {closed} closed, {open} open"),
    noted("pins {low} to {high} apart; the cylinder is {closed} closed"),
    noted("travels {travel}, its stroke is {stroke}"),
    noted("{gap} missing"),
    noted("pins {low} to {high} apart"),
    noted("its length stands still at about {where}, where its thrust moves nothing"),
    noted("needs up to {pressure} at {where}; {most} are allowed"),
    noted("needs up to {pressure} at {where}"),
    noted("least reserve {reserve} at {where}"),
    noted("all live verdicts hold"),
    noted("does not hold"),
    noted("{count} verdicts fail"),
    noted("Hide {name}"),
    noted("{name} = {text}: a number is expected"),
    noted("Add a dimension …"),
    noted("Copied"),
    noted("Copy link"),
    noted("Light or dark"),
    noted("The link"),
    noted("Reset"),
    noted("Back to the delivered design"),
    noted("A link to this page that restores what is shown"),
    noted("Language"),
    noted("The mechanism"),
    noted("Play and pause: the space bar"),
    noted("Plays"),
    noted("Speed"),
    noted("Forces"),
    noted("Arrows of the pin forces and the loads"),
    noted("Curve"),
    noted("with"),
    noted("The result over the stroke"),
    noted("Dimensions"),
    noted("Show another dimension"),
    noted("Verdicts and limits, live"),
    noted("Verdicts of the delivered design"),
    noted("the design has changed since"),
    noted("Space plays; arrow keys, Home and End move the stroke. Drag a ground pin; double-click a name to put it back."),
    noted("Play"),
    noted("Pause"),
)


def words_in(name: str) -> dict[str, str]:
    """Return what a page says, in a language, by the English."""
    with language(name):
        return {each: translated(each) for each in SAID}
