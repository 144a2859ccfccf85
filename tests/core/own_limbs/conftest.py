import pytest

from tests.core.own_limbs.lab_bench import installed


@pytest.fixture
def lab(user_data):
    """A limb that was imported as lab-1."""
    return installed()
