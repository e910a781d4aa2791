"""What a live page says, in Russian, by what it says in English; `{gap}` and the like are filled in there."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

RUSSIAN: Mapping[str, str] = MappingProxyType(
    {
        "{what}: a change point, where two branches cross": "{what}: точка ветвления, где пересекаются две ветви",
        "{what}: {step} is {gap} mm short": "{what}: {step} — не хватает {gap} мм",
        "{what}: {step} cannot be placed": "{what}: {step} не собирается",
        "{what} stops here": "{what} дальше не идёт",
        "Drag {name}": "Перетащить {name}",
        "longest arrow {force}": "наибольшая стрелка {force}",
        "as delivered only: this column is not followed in the page": "только для исходного варианта: на странице не пересчитывается",
        "dashed: as delivered": "штрихи: исходный вариант",
        "reach": "сборка",
        "assembled over the whole stroke, {stroke} from {from} to {to}": "собирается на всём ходе, {stroke} от {from} до {to}",
        "{from} to {to}": "от {from} до {to}",
        "not assembled at {stroke} = {spans}": "не собирается при {stroke} = {spans}",
        "dead point": "мёртвая точка",
        "the nearest is at {joint}: least transmission angle {angle} at {where}": "ближайшая в {joint}: наименьший угол передачи {angle} при {where}",
        "of {step} at {where}, where the reach ends": "{step} при {where}: здесь ход кончается",
        "least {extreme} at {where}; not below {limit} ({text})": "наименьшее {extreme} при {where}; не ниже {limit} ({text})",
        "greatest {extreme} at {where}; not above {limit} ({text})": "наибольшее {extreme} при {where}; не выше {limit} ({text})",
        "{gap} too long closed": "во втянутом виде длиннее на {gap}",
        "{gap} missing open": "в выдвинутом виде не хватает {gap}",
        "pins {low} to {high} apart; the cylinder is {closed} closed, {open} open": (
            "между осями от {low} до {high}; гидроцилиндр втянут {closed}, выдвинут {open}"
        ),
        "pins {low} to {high} apart; the cylinder is {closed} closed": "между осями от {low} до {high}; гидроцилиндр втянут {closed}",
        "travels {travel}, its stroke is {stroke}": "перемещение {travel}, ход {stroke}",
        "{gap} missing": "не хватает {gap}",
        "pins {low} to {high} apart": "между осями от {low} до {high}",
        "its length stands still at about {where}, where its thrust moves nothing": "длина не меняется около {where}: усилие здесь не движет",
        "needs up to {pressure} at {where}; {most} are allowed": "нужно до {pressure} при {where}; допускается {most}",
        "needs up to {pressure} at {where}": "нужно до {pressure} при {where}",
        "least reserve {reserve} at {where}": "наименьший запас {reserve} при {where}",
        "all live verdicts hold": "все текущие проверки выполнены",
        "does not hold": "не выполнено",
        "{count} verdicts fail": "не выполнено проверок: {count}",
        "Hide {name}": "Убрать {name}",
        "{name} = {text}: a number is expected": "{name} = {text}: нужно число",
        "Add a dimension …": "Добавить размер …",
        "Copied": "Скопировано",
        "Copy link": "Ссылка",
        "Light or dark": "Светлая или тёмная",
        "The link": "Ссылка",
        "Reset": "Сброс",
        "Back to the delivered design": "Вернуть исходный вариант",
        "A link to this page that restores what is shown": "Ссылка, которая восстанавливает показанное",
        "Language": "Язык",
        "The mechanism": "Механизм",
        "Play and pause: the space bar": "Пуск и пауза: пробел",
        "Plays": "Ход",
        "Speed": "Скорость",
        "Forces": "Силы",
        "Arrows of the pin forces and the loads": "Стрелки сил в шарнирах и нагрузок",
        "Curve": "Кривая",
        "with": "и",
        "The result over the stroke": "Результат по ходу",
        "Dimensions": "Размеры",
        "Show another dimension": "Показать ещё размер",
        "Verdicts and limits, live": "Проверки и пределы, текущие",
        "Verdicts of the delivered design": "Заключение по исходному варианту",
        "the design has changed since": "вариант с тех пор изменён",
        (
            "Space plays and pauses; the arrow keys, Home and End move the stroke. Ground pins can be dragged in the drawing; "
            "a double click on a name puts a dimension back."
        ): "Пробел — пуск и пауза; стрелки, Home и End двигают ход. Опоры можно перетаскивать; двойной щелчок по имени возвращает размер.",
        "Play": "Пуск",
        "Pause": "Пауза",
    }
)
