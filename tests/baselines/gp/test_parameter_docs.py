"""Parameters are documented once, and every model that takes them says what they mean."""

import ast
import inspect
import re

import pytest

from mocapbench.baselines import HGP, MOA, MOHGP, GPIndependent, LMCIndependent
from mocapbench.baselines.gp import channelwise, estimator
from mocapbench.baselines.gp.estimator import GaussianProcess
from mocapbench.baselines.gp.parameter_docs import document_like

JOINT, CHANNELWISE = (MOHGP, MOA, LMCIndependent), (HGP, GPIndependent)
OTHERWISE_MEANT = ["max_seconds", "n_components", "n_restarts"]
"""Those that a model of each channel counts over channels."""


def entries(docstring, title="Parameters"):
    """Return what is before the colon in the entries of a section, one after the other."""
    _, _, section = inspect.cleandoc(docstring).partition(f"{title}\n{'-' * len(title)}\n")
    section, *_ = re.split(r"^\w+\n-+\n", section, flags=re.MULTILINE)
    return re.findall(r"^(\S.*) : ", section, flags=re.MULTILINE)


def written(model):
    """Return the parameters that the docstring in the source of a class documents."""
    source = inspect.getsource(model)
    return entries(re.search(r'r?"""(.*?)"""', source, flags=re.DOTALL)[1])


def test_the_thirteen_parameters_are_documented_once():
    shared = list(inspect.signature(GaussianProcess).parameters)
    assert len(shared) == 13
    assert written(GaussianProcess) == shared
    models = (estimator.GaussianProcess, channelwise.Channelwise, *JOINT, *CHANNELWISE)
    again = [name for model in models[1:] for name in written(model) if name in shared]
    assert sorted(again) == OTHERWISE_MEANT


@pytest.mark.parametrize("model", [*JOINT, *CHANNELWISE])
def test_a_model_documents_all_its_parameters_in_their_order(model):
    assert entries(model.__doc__) == list(inspect.signature(model).parameters)


@pytest.mark.parametrize("model", [*JOINT, *CHANNELWISE])
def test_documented_defaults_are_those_of_the_signature(model):
    kinds = re.findall(r"^(\w+) : .*default=(\S+?)(?:, or (\S+) for (\w+))?$", model.__doc__, re.M)
    documented = {
        name: ast.literal_eval(own if whose == model.__name__ else usual)
        for name, usual, own, whose in kinds
    }
    parameters = inspect.signature(model).parameters.values()
    assert documented == {parameter.name: parameter.default for parameter in parameters}


@pytest.mark.parametrize("model", JOINT)
def test_a_model_documents_what_it_has_learnt(model):
    assert {"process_", "coregionalisation_", "noise_"} <= {*entries(model.__doc__, "Attributes")}


class Source:
    """Be a source.

    Parameters
    ----------
    one : int
        As in the source,
        over two lines.
    two : int
        As in the source.

    Attributes
    ----------
    learnt_ : int
        As in the source.
    """

    def __init__(self, one=1, two=2):
        self.one, self.two = one, two


def test_what_a_class_says_itself_stands():
    @document_like(Source)
    class Model:
        """Be a model.

        It does more.

        Parameters
        ----------
        two : float
            Otherwise meant.

        Examples
        --------
        >>> Model()
        """

        def __init__(self, three=3, two=2, one=1):
            pass

    assert inspect.cleandoc(Model.__doc__) == inspect.cleandoc(
        """Be a model.

        It does more.

        Parameters
        ----------
        two : float
            Otherwise meant.
        one : int
            As in the source,
            over two lines.

        Examples
        --------
        >>> Model()
        """
    )


def test_a_subclass_says_what_it_has_learnt():
    @document_like(Source)
    class Model(Source):
        """Be a model."""

    assert Model.__doc__ == inspect.cleandoc(Source.__doc__).replace("source.", "model.", 1)


def test_there_may_be_no_docstrings():
    class Silent:
        pass

    assert document_like(Source)(Silent).__doc__ is None
    assert document_like(Silent)(Source).__doc__.startswith("Be a source.")
