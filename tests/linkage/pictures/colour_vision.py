"""How far colours differ for the eye: CIELAB, CIEDE2000, and what colour-blind readers see."""

import numpy as np

SIGHT = {  # linear RGB to what is seen; Machado, Oliveira and Fernandes (2009), severity 1.0
    "normal": np.eye(3),
    "protan": np.array([[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]),
    "deutan": np.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]),
    "tritan": np.array([[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]),
}
XYZ = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]])  # of sRGB, D65


def linear(colour):
    """Return the linear RGB of a colour written `#rrggbb`, shape (3,)."""
    part = np.array([int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)])
    return np.where(part <= 0.04045, part / 12.92, ((part + 0.055) / 1.055) ** 2.4)


def lab(colour, sight="normal"):
    """Return a colour as it is seen in CIELAB, shape (3,)."""
    share = XYZ @ np.clip(SIGHT[sight] @ linear(colour), 0.0, 1.0) / XYZ.sum(axis=1)
    x, y, z = np.where(share > 216 / 24389, np.cbrt(share), (24389 / 27 * share + 16) / 116)
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


def luminance(colour):
    """Return a colour's relative luminance."""
    return float(XYZ[1] @ linear(colour))


def contrast(one, other):
    """Return the contrast of two colours by WCAG 2."""
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def ciede2000(one, other):
    """Return the difference of two colours in CIELAB. Source: Sharma, Wu and Dalal (2005)."""
    (L1, a1, b1), (L2, a2, b2) = one, other
    mean = 0.5 * (np.hypot(a1, b1) + np.hypot(a2, b2))
    grey = 0.5 * (1 - np.sqrt(mean**7 / (mean**7 + 25.0**7)))
    C1, C2 = np.hypot(a1 * (1 + grey), b1), np.hypot(a2 * (1 + grey), b2)
    h1, h2 = np.degrees(np.arctan2(b1, a1 * (1 + grey))) % 360, np.degrees(np.arctan2(b2, a2 * (1 + grey))) % 360
    turn = (h2 - h1 + 180) % 360 - 180 if C1 * C2 else 0.0
    hue = 2 * np.sqrt(C1 * C2) * np.sin(np.radians(turn / 2))
    L, C = 0.5 * (L1 + L2), 0.5 * (C1 + C2)
    h = h1 + h2 if not C1 * C2 else 0.5 * (h1 + h2) if abs(h1 - h2) <= 180 else 0.5 * (h1 + h2 + (360 if h1 + h2 < 360 else -360))
    T = 1 + sum(k * np.cos(np.radians(m * h - d)) for k, m, d in ((-0.17, 1, 30), (0.24, 2, 0), (0.32, 3, -6), (-0.20, 4, 63)))
    SL, SC, SH = 1 + 0.015 * (L - 50) ** 2 / np.sqrt(20 + (L - 50) ** 2), 1 + 0.045 * C, 1 + 0.015 * C * T
    RT = -np.sin(np.radians(60 * np.exp(-(((h - 275) / 25) ** 2)))) * 2 * np.sqrt(C**7 / (C**7 + 25.0**7))
    dL, dC, dH = (L2 - L1) / SL, (C2 - C1) / SC, hue / SH
    return float(np.sqrt(dL**2 + dC**2 + dH**2 + RT * dC * dH))
