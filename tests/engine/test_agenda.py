"""The order in which the files of a batch go out: nobody waits for a plan, the longest go first, all go once."""

import random
from collections import Counter
from collections.abc import Iterator, Mapping
from heapq import heappop, heappush
from itertools import pairwise

import pytest

from ptmcalc.engine.agenda import CHUNK, MOST_IN_CHUNK, Agenda, Portion

LOOK = 0.02


def shared(seconds: Mapping[int, tuple[bytes, float]], workers: int) -> tuple[float, list[Portion]]:
    """When the last of so many workers would be ready, of files of a kind that take so long, by a clock of our own;
    and what went out, in that order. One portion more than there are workers is under way."""
    agenda = Agenda({index: kind for index, (kind, _) in seconds.items()})
    free, under_way, sent, queue = [0.0] * workers, [], [], []
    last = 0.0
    while True:
        while len(under_way) < workers + 1:
            portion = agenda.next(workers, looking=any(one.patience == CHUNK for _, _, one in under_way))
            if portion is None:
                break
            sent.append(portion)
            spent = sum(taken(seconds[index][1], portion.patience) for index in portion.files)
            start = max(heappop(free), queue[-1] if queue else 0.0)
            heappush(free, start + spent)
            heappush(under_way, (start + spent, len(sent), portion))
        if not under_way:
            assert agenda.expected == pytest.approx(sum(s for _, s in seconds.values()))
            return last, sent
        last, _, portion = heappop(under_way)
        queue.append(last)
        for index in portion.files:
            whole = seconds[index][1]
            agenda.is_done(index, whole) if whole <= portion.patience else agenda.came_back(index, whole)


def taken(seconds: float, patience: float) -> float:
    return seconds if seconds <= patience else LOOK


def mixed() -> Iterator[tuple[bytes, float]]:
    """Forty files like those of the specs: kinds whose files take from milliseconds to seconds."""
    draw = random.Random(4)
    for kind, low, high in (
        (b"conveyor", 0.01, 8.0),
        (b"shaft", 0.05, 1.0),
        (b"hoist", 0.01, 0.4),
        (b"", 0.003, 0.003),
    ):
        for _ in range(10):
            yield kind, low * (high / low) ** draw.random()


FOLDERS = {
    "mixed": list(mixed()),
    "mixed, the longest at the end": sorted(mixed(), key=lambda one: one[1]),
    "22 quick ones": [(b"hoist", 0.2 + 0.01 * index) for index in range(22)],
    "many, of which one in the middle is long": [*[(b"hoist", 0.006)] * 1500, (b"hoist", 9.0)]
    + [(b"hoist", 0.006)] * 1500,
}


@pytest.mark.parametrize("name", FOLDERS)
def test_two_workers_share_a_folder_almost_evenly(name: str) -> None:
    files = dict(enumerate(FOLDERS[name]))
    last, sent = shared(files, 2)
    counted = Counter(index for portion in sent for index in portion.files)
    assert set(counted) == set(files)
    assert {index for index, number in counted.items() if number > 1} == {i for i, (_, s) in files.items() if s > CHUNK}
    alone = sum(seconds for _, seconds in files.values())
    assert alone / last > 1.7


def test_of_those_that_came_back_the_longest_goes_first() -> None:
    """Of those that are known; beside them some that nobody has looked at are always under way."""
    long = {index: (b"conveyor", 1.0 + index) for index in range(12)}
    _, sent = shared(long | dict.fromkeys(range(12, 250), (b"hoist", 0.1)), 2)
    alone = [number for number, portion in enumerate(sent) if portion.patience > CHUNK]
    looks = [number for number, portion in enumerate(sent) if portion.patience == CHUNK]
    assert sorted(sent[number].files for number in alone) == [(index,) for index in range(12)]
    assert [sent[number].files for number in alone[4:]] == sorted((sent[n].files for n in alone[4:]), reverse=True)
    assert all(later - earlier <= 3 for earlier, later in pairwise(looks))
    assert looks[-1] > alone[2]


def test_kinds_that_nobody_has_seen_go_first_and_one_at_a_time() -> None:
    agenda = Agenda({index: b"ab"[index // 50 : index // 50 + 1] for index in range(100)})
    assert agenda.expected == 0, "nothing is known, so nothing is claimed"
    first = agenda.next(2)
    assert first is not None
    assert len(first.files) <= CHUNK / 0.1
    for index in first.files:
        agenda.is_done(index, 0.1)
    assert agenda.expected == pytest.approx(10.0)
    second = agenda.next(2)
    assert second is not None
    assert {index < 50 for index in first.files} == {not index < 50 for index in second.files}


def test_portions_are_large_in_the_middle_and_small_at_the_end() -> None:
    agenda = Agenda(dict.fromkeys(range(5000), b"a"))
    sizes = []
    while (portion := agenda.next(2)) is not None:
        sizes.append(len(portion.files))
        for index in portion.files:
            agenda.is_done(index, 0.0005)
    assert sum(sizes) == 5000
    assert max(sizes) <= MOST_IN_CHUNK
    assert max(sizes) > 100
    assert sizes[-8:] == [1] * 8
