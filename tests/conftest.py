"""Examples are judged by what comes out, never by how long a busy machine takes for them."""

from hypothesis import settings

settings.register_profile("steady", deadline=None)
settings.load_profile("steady")
