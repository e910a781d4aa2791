"""The browser page: a mechanism that moves, in one file that needs no network."""

from .page import page as page
