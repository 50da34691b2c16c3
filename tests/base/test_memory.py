"""What is remembered of the very objects a function was given."""

from ptmcalc.base.memory import forget, kept_for


class Machine:
    """Equal to every other one, and told apart by identity only."""

    def __eq__(self, other: object) -> bool:
        return True

    __hash__ = None  # type: ignore[assignment]


def counted(size: int) -> tuple[list[tuple[object, ...]], object]:
    made: list[tuple[object, ...]] = []

    @kept_for(size)
    def function(*arguments: object) -> int:
        made.append(arguments)
        return len(made)

    return made, function


def test_the_same_objects_are_answered_from_memory_and_equal_ones_are_not() -> None:
    made, function = counted(10)
    one, other = Machine(), Machine()
    assert [function(one), function(one), function(other), function(one, other), function(one)] == [1, 1, 2, 3, 1]  # type: ignore[operator]
    assert len(made) == 3


def test_an_object_is_held_as_long_as_its_answer_so_that_no_other_takes_its_identity() -> None:
    _, function = counted(1000)
    answers = [function(Machine()) for _ in range(500)]  # type: ignore[operator]
    assert answers == list(range(1, 501))


def test_no_more_is_held_than_said_and_nothing_after_forget() -> None:
    made, function = counted(2)
    machines = [Machine() for _ in range(3)]
    for machine in machines:
        function(machine)  # type: ignore[operator]
    assert function(machines[2]) == 3  # type: ignore[operator]
    assert function(machines[0]) == 4, "the oldest went"  # type: ignore[operator]
    forget()
    function(machines[0])  # type: ignore[operator]
    assert len(made) == 5
