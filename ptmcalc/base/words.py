"""Pieces of sentences that every floor writes alike."""

_LONGEST = 80


def quote(text: str) -> str:
    """Text of a file between backticks; of a long one the beginning, so that it does not bury the message."""
    return f"`{text}`" if len(text) <= _LONGEST else f"`{text[: _LONGEST - 1]}…`"


def shown(text: str) -> str:
    """Text in which what a terminal would obey or not show is written as an escape."""
    return text if text.isprintable() else "".join(map(_shown, text))


def _shown(char: str) -> str:
    return char if char.isprintable() else char.encode("unicode_escape").decode()


def with_article(noun: str) -> str:
    """`an angle`, `a mass`."""
    return f"{'an' if noun[:1] in 'aeio' else 'a'} {noun}"
