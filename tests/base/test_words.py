"""Text of a file inside a sentence."""

import pytest

from ptmcalc.base.words import quote, with_article


def test_text_of_the_file_stands_between_backticks() -> None:
    assert quote("18 m") == "`18 m`"


def test_a_long_text_is_cut_and_shows_that_it_is() -> None:
    assert quote("x" * 80) == f"`{'x' * 80}`"
    assert quote("x" * 1_000_000) == f"`{'x' * 79}…`"


@pytest.mark.parametrize(("noun", "said"), [("angle", "an angle"), ("energy", "an energy"), ("mass", "a mass")])
def test_an_article_fits_its_noun(noun: str, said: str) -> None:
    assert with_article(noun) == said
