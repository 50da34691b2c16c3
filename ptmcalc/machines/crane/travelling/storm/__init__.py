"""Storm: wind out of service."""
