/// A value that several parts of the page show: who sets it tells all of them.
export class Shared<T> {
  private readonly listeners: ((value: T) => void)[] = [];
  constructor(public value: T) {}

  set(value: T): void {
    this.value = value;
    this.listeners.forEach((tell) => tell(value));
  }

  on(tell: (value: T) => void): void {
    this.listeners.push(tell);
  }
}
