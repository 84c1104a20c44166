"""An absorber under conditions that vary."""
