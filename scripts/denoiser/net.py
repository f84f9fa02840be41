"""The denoiser's net, and what goes in and out of it; src/passes/denoise.md has the same in words.

A recurrent autoencoder after Chaitanya et al. 2017, "Interactive Reconstruction of Monte Carlo Image Sequences using a
Recurrent Denoising Autoencoder", with the widths of Tatzgern 2020, "Stochastic Substitute Trees for Real-Time Global
Illumination". It corrects what light_filter makes of light.
"""
import torch
from torch import nn
from torch.nn import functional

INPUTS, OUTPUTS = 20, 6
ENCODER = (24, 40, 54, 72, 96, 96)
DECODER = ((96, 96), (72, 72), (54, 54), (40, 40), (64, 32))
SLOPE = 0.1  # of the leaky ReLU below 0
MULTIPLE = 2 ** (len(ENCODER) - 1)  # of which sizes have to be
U_MOST = 20.0
NEAR = 3  # pixels to the side of the window in which specular light may be blended


class Net(nn.Module):
    """Layers stand in the order in which the weights file has them."""

    def __init__(self):
        super().__init__()
        self.layers = nn.ModuleDict()
        before = INPUTS
        for i, width in enumerate(ENCODER, 1):
            self.layers[f"enc{i}a"] = nn.Conv2d(before, width, 3, padding=1)
            self.layers[f"enc{i}b"] = nn.Conv2d(2 * width, width, 3, padding=1)
            before = width
        for j, (up, width) in zip(range(len(DECODER), 0, -1), DECODER):
            self.layers[f"dec{j}a"] = nn.ConvTranspose2d(before, up, 2, stride=2)
            self.layers[f"dec{j}b"] = nn.Conv2d(up + ENCODER[j - 1], width, 3, padding=1)
            before = width
        self.layers["out"] = nn.Conv2d(before, OUTPUTS, 3, padding=1)
        for layer in self.layers.values():
            nn.init.kaiming_normal_(layer.weight, SLOPE)
            nn.init.zeros_(layer.bias)
        # At first it changes nothing.
        nn.init.zeros_(self.layers["out"].weight)

    def forward(self, x, state=None):
        """x: (batch, INPUTS, height, width), sizes multiples of MULTIPLE. Returns the change of u, and the state."""
        kept = []
        for i in range(1, len(ENCODER) + 1):
            if i > 1:
                x = functional.max_pool2d(x, 2)
            x = functional.leaky_relu(self.layers[f"enc{i}a"](x), SLOPE)
            hidden = state[i - 1] if state else torch.zeros_like(x)
            x = functional.leaky_relu(self.layers[f"enc{i}b"](torch.cat((x, hidden), 1)), SLOPE)
            kept.append(x)
        for j in range(len(DECODER), 0, -1):
            x = torch.cat((self.layers[f"dec{j}a"](x), kept[j - 1]), 1)
            x = functional.leaky_relu(self.layers[f"dec{j}b"](x), SLOPE)
        return self.layers["out"](x), kept


def padded(x):
    """Repeats the last row and column up to the next multiple."""
    height, width = x.shape[-2:]
    return functional.pad(x, (0, -width % MULTIPLE, 0, -height % MULTIPLE), mode="replicate")


def corrected(x, change):
    """u of the light that comes out, of an example (light.py) and the change. Of specular light the net chooses how far it
    goes to its neighbours' mean: what is dark in a reflection is not made bright."""
    u = torch.clamp(x[:, 6:12] + change, 0.0, U_MOST)
    light, told = x[:, 9:12], (x[:, 27:28] > 0).to(x.dtype)
    near = [functional.avg_pool2d(part, NEAR, 1, NEAR // 2) for part in (light * told, told)]
    mean = torch.where(told > 0, near[0] / near[1].clamp(min=1e-6), light)
    blended = torch.minimum(torch.maximum(u[:, 3:], torch.minimum(light, mean)), torch.maximum(light, mean))
    return torch.cat((u[:, :3], blended), 1)
