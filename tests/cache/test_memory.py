"""The memory tier holds what is worth most per byte, within its budget, counting every array once."""

import platform
import subprocess
import sys
import threading

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphface.cache.memory import MISSING, MemoryTier

KIB = 1024


def array(kib: int = 1) -> np.ndarray:
    return np.zeros(kib * KIB, np.uint8)


def key(number: int) -> bytes:
    return number.to_bytes(16, "big")


class TestValues:
    def test_get(self) -> None:
        """A value comes back as the same object."""
        tier, held = MemoryTier(), array()
        tier.put(key(1), held, 1.0, (held,))
        assert tier.get(key(1)) is held
        assert key(1) in tier

    @pytest.mark.parametrize("value", [None, 0, False, ""])
    def test_falsy(self, value: object) -> None:
        """A value that is nothing is held like any other."""
        tier = MemoryTier()
        tier.put(key(1), value, 1.0)
        assert tier.get(key(1)) is value

    def test_missing(self) -> None:
        """What is not there is `MISSING`, not None."""
        assert MemoryTier().get(key(1)) is MISSING

    def test_first_put_stays(self) -> None:
        """A key means one value: the first one put."""
        tier = MemoryTier()
        tier.put(key(1), "first", 1.0)
        tier.put(key(1), "second", 1.0)
        assert tier.get(key(1)) == "first"

    def test_clear(self) -> None:
        """Cleared, it holds nothing and counts nothing."""
        tier, held = MemoryTier(), array()
        tier.put(key(1), held, 1.0, (held,))
        tier.clear()
        assert (len(tier), tier.held_bytes, tier.get(key(1))) == (0, 0, MISSING)


class TestBudget:
    def test_shared_array_counts_once(self) -> None:
        """An array is counted once however many values hold it."""
        tier, held = MemoryTier(), array(100)
        for number in range(10):
            tier.put(key(number), held, 1.0, (held,))
        assert 100 * KIB <= tier.held_bytes < 110 * KIB

    def test_shared_array_counts_until_the_last(self) -> None:
        """Its bytes are given back when its last holder goes, not before."""
        tier, held = MemoryTier(budget=150 * KIB), array(100)
        tier.put(key(1), held, 0.0, (held,))
        tier.put(key(2), held, 1.0, (held,))
        other = array(60)
        tier.put(key(3), other, 5.0, (other,))
        assert tier.held_bytes <= 150 * KIB
        assert key(3) in tier
        assert key(2) not in tier

    def test_larger_than_the_budget(self) -> None:
        """A value larger than the whole budget is not kept, and drops nothing."""
        tier, small, large = MemoryTier(budget=10 * KIB), array(1), array(11)
        tier.put(key(1), small, 1.0, (small,))
        tier.put(key(2), large, 100.0, (large,))
        assert key(1) in tier
        assert key(2) not in tier

    @given(
        st.lists(st.tuples(st.integers(0, 30), st.integers(1, 12), st.floats(0, 10), st.booleans()), max_size=60),
        st.integers(4, 40),
    )
    def test_never_above(self, puts: list[tuple[int, int, float, bool]], budget: int) -> None:
        """After any sequence of puts and gets the count is right and not above the budget."""
        tier, pool = MemoryTier(budget=budget * KIB), [array(k) for k in range(1, 13)]
        for number, size, seconds, look in puts:
            held = (pool[size - 1], pool[0])
            if look:
                tier.get(key(number))
            tier.put(key(number), held, seconds, held)
            assert tier.held_bytes <= tier.budget
            alive = {id(a): a.nbytes for entry in tier._held.values() for a in entry[2]}
            assert tier.held_bytes == sum(alive.values()) + 200 * len(tier)


class TestEviction:
    def test_cheapest_per_byte_goes_first(self) -> None:
        """What costs least to compute again per byte held goes first, whenever it was used."""
        tier = MemoryTier(budget=100 * KIB)
        for number, seconds in ((1, 5.0), (2, 0.1), (3, 9.0)):
            held = array(40)
            tier.put(key(number), held, seconds, (held,))
        assert [key(n) in tier for n in (1, 2, 3)] == [True, False, True]

    def test_size_matters(self) -> None:
        """Of two equally dear, the larger goes."""
        tier = MemoryTier(budget=100 * KIB)
        for number, kib in ((1, 10), (2, 60), (3, 40)):
            held = array(kib)
            tier.put(key(number), held, 1.0, (held,))
        assert [key(n) in tier for n in (1, 2, 3)] == [True, False, True]

    def test_longest_unused_among_equals(self) -> None:
        """Among equals the longest unused goes."""
        tier = MemoryTier(budget=100 * KIB)
        for number in (1, 2):
            held = array(40)
            tier.put(key(number), held, 1.0, (held,))
        tier.get(key(1))
        held = array(40)
        tier.put(key(3), held, 1.0, (held,))
        assert [key(n) in tier for n in (1, 2, 3)] == [True, False, True]

    def test_cheap_holders_of_one_array(self) -> None:
        """Many cheap values over one large array do not keep it at the expense of a dear one."""
        tier, photo = MemoryTier(budget=100 * KIB), array(50)
        tier.put(key(1), photo, 1e-3, (photo,))
        tier.put(key(2), photo, 1e-6, (photo,))
        for number in (3, 4):
            dear = array(30)
            tier.put(key(number), dear, 5.0, (dear,))
        assert [key(n) in tier for n in (1, 2, 3, 4)] == [False, False, True, True]

    def test_newest_stays(self) -> None:
        """What was just computed is not dropped to make room for what was there."""
        tier, old, new = MemoryTier(budget=100 * KIB), array(80), array(80)
        tier.put(key(1), old, 100.0, (old,))
        tier.put(key(2), new, 0.0, (new,))
        assert key(2) in tier

    def test_remembered(self) -> None:
        """What was evicted is known, so that a run can say why it computes it again."""
        tier = MemoryTier(budget=50 * KIB)
        for number in (1, 2):
            held = array(40)
            tier.put(key(number), held, 1.0, (held,))
        assert tier.was_evicted(key(1))
        assert not tier.was_evicted(key(2))

    def test_forgotten(self) -> None:
        """Only the last evictions are remembered: a tier that is used for weeks does not grow."""
        tier = MemoryTier(budget=50 * KIB)
        for number in range(20_000):
            tier.put(key(number), 1.0, 1.0)
        tier.clear()
        assert len(tier._evicted) <= 4096
        assert tier.was_evicted(key(19_999))
        assert not tier.was_evicted(key(0))


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="only glibc can be asked to give memory back")
class TestResident:
    """What a process holds, in blocks of 1 MB, which glibc keeps once it has freed a larger one."""

    PROGRAM = """
import resource
import numpy as np
from graphface.cache.memory import MemoryTier

def resident():
    return int(open("/proc/self/statm").read().split()[1]) * resource.getpagesize() / 1e6

def fill(tier, count):
    for number in range(count):
        held = np.ones(1 << 20, np.uint8)
        tier.put(number.to_bytes(8, "big"), held, 1.0, (held,))

large = np.ones(30 << 20, np.uint8)
del large
tier = MemoryTier(budget=300 << 20)
before = resident()
"""

    def resident(self, program: str) -> list[float]:
        done = subprocess.run(
            [sys.executable, "-c", self.PROGRAM + program], capture_output=True, text=True, timeout=60
        )
        assert done.returncode == 0, done.stderr
        return [float(part) for part in done.stdout.split()]

    def test_clear(self) -> None:
        """Clearing a tier gives its memory back."""
        before, full, after = self.resident(
            "fill(tier, 200)\nfull = resident()\ntier.clear()\nprint(before, full, resident())"
        )
        assert full > before + 200
        assert after < before + 20

    def test_large_eviction(self) -> None:
        """So does a large value that pushes out many others."""
        before, full, after = self.resident(
            "fill(tier, 200)\nfull = resident()\nlarge = np.zeros(290 << 20, np.uint8)\n"
            "tier.put(b'large', large, 1e9, (large,))\nprint(before, full, resident())"
        )
        assert full > before + 200
        assert after < before + 20  # pages of zeros that nobody has written to are not there yet


class TestThreads:
    def test_puts_and_gets(self) -> None:
        """Threads may share it: counts stay right."""
        tier, pool = MemoryTier(budget=64 * KIB), [array(1 + k % 7) for k in range(200)]

        def work(offset: int) -> None:
            for step in range(400):
                number = (step * 7 + offset) % 200
                if tier.get(key(number)) is MISSING:
                    tier.put(key(number), pool[number], 1.0, (pool[number],))
                tier.put(key(1000 + number), float(number), 1.0)
                assert tier.get(key(1000 + number)) in (float(number), MISSING)

        threads = [threading.Thread(target=work, args=(i * 31,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert (
            tier.held_bytes
            == sum(v.nbytes for entry in tier._held.values() for v in entry[2]) + 200 * len(tier)
            <= tier.budget
        )
