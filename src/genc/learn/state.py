"""What a training run must remember, as named tensors."""

from __future__ import annotations

from collections.abc import Mapping

import torch
from torch import Tensor, nn


def named_state(modules: Mapping[str, nn.Module], optimizer: torch.optim.Optimizer) -> dict[str, Tensor]:
    """The weights of all modules and the moments of the optimizer."""
    named = {f"{name}.{k}": v for name, module in modules.items() for k, v in module.state_dict().items()}
    for index, moments in optimizer.state_dict()["state"].items():
        named |= {f"optimizer.{index}.{k}": v for k, v in moments.items()}
    return named


def restore_state(
    state: Mapping[str, Tensor], modules: Mapping[str, nn.Module], optimizer: torch.optim.Optimizer
) -> None:
    """Puts back what `named_state` gave."""
    for name, module in modules.items():
        module.load_state_dict(under(f"{name}.", state))
    moments: dict[int, dict[str, Tensor]] = {}
    for key, tensor in under("optimizer.", state).items():
        index, name = key.split(".")
        moments.setdefault(int(index), {})[name] = tensor
    optimizer.load_state_dict({**optimizer.state_dict(), "state": moments})


def under(prefix: str, state: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """The tensors whose names begin so, without that beginning."""
    return {key.removeprefix(prefix): tensor for key, tensor in state.items() if key.startswith(prefix)}
