const {sqrt:Q,sin:S,cos:C,tan:T,exp:E,log:L,pow:P,abs:A,atan2:X}=Math,V=2*Math.PI;
const I=(a,b)=>a<=b||a!=a?a:b,M=(a,b)=>a>=b||a!=a?a:b,G=a=>a>0?1:a<0?-1:a;
// The unknowns of n equations: n * n entries by rows, then the right side; by elimination with row pivots.
const J=e=>{
  const n=(Q(4*e.length+1)-1)/2,r=[];
  for(let k=0;k<n;k++)r.push([...e.slice(k*n,k*n+n),e[n*n+k]]);
  for(let k=0;k<n;k++){
    let b=k;
    for(let i=k+1;i<n;i++)if(A(r[i][k])>A(r[b][k]))b=i;
    const t=r[b];r[b]=r[k];r[k]=t;
    if(!(A(t[k])>0))return Array(n).fill(NaN);
    for(let i=k+1;i<n;i++){
      const f=r[i][k]/t[k];
      if(f)for(let j=k;j<=n;j++)r[i][j]-=f*t[j];
    }
  }
  for(let k=n;k--;){
    let s=r[k][n];
    for(let j=k+1;j<n;j++)s-=r[k][j]*r[j][n];
    r[k][n]=s/r[k][k];
  }
  return r.map(a=>a[n]);
};
